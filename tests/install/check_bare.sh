#!/usr/bin/env bash
# check_bare.sh FOLDER: takes the packages that tools/package wrote to FOLDER to a bare Debian 12, made by mmdebstrap. There the
# tarball's program must run without any library of its own installed, and apt-get must install the .deb. Needs root and the
# network; exit code 77 without root.
set -euo pipefail
folder=${1:?check_bare.sh FOLDER}
fail() { echo "check_bare: $*" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || { echo "skipped: needs root"; exit 77; }
tarball=$(echo "$folder"/genu-*-linux.tar.gz) deb=$(echo "$folder"/genu_*.deb)
[ -f "$tarball" ] && [ -f "$deb" ] || fail "$folder must hold one tarball and one .deb: run tools/package first"

work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
chmod 755 "$work"
root=$work/root
mmdebstrap --quiet --variant=minbase bookworm "$root" || fail "mmdebstrap failed"
cp /etc/resolv.conf "$root/etc/"
# Mounts end with the command.
inside() { unshare --mount --pid --fork chroot "$root" /bin/sh -c "mount -t proc proc /proc && $1"; }

for library in libfcl libassimp libtbb libfmt libsundials; do
  [ -z "$(find "$root/usr" "$root/opt" -name "$library*")" ] || fail "this Debian is not bare: it has $library"
done

# check_program PROGRAM SHARE: solves a shipped scene, finds the hard cases beside itself.
check_program() {
  rm -rf "$root/tmp/out"
  inside "$1 run $2/genu/meshes/dortmans1984/scene.toml --quiet --out /tmp/out" || fail "$1 run failed"
  [ "$(wc -l < "$root/tmp/out/results.csv")" -eq 72 ] || fail "$1: results.csv has not 71 rows"
  [ -s "$root/tmp/out/report.html" ] || fail "$1 wrote no report.html"
  inside "$1 hard-cases --case ball_on_a_ball" > "$work/log" 2>&1 || { cat "$work/log"; fail "$1 hard-cases failed"; }
}
mkdir "$root/opt/moved"
tar -C "$root/opt/moved" --strip-components=1 -xzf "$tarball"
check_program /opt/moved/bin/genu /opt/moved/share

cp "$deb" "$root/tmp/"
inside "apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends /tmp/$(basename "$deb")" \
  > "$work/apt" 2>&1 || { tail -30 "$work/apt"; fail "apt-get cannot install $(basename "$deb")"; }
mv "$root/opt/moved" "$root/opt/away"
check_program /usr/bin/genu /usr/share
echo "on a bare Debian: $(basename "$tarball") ($(($(stat -c %s "$tarball") / 1000)) kB) runs, $(basename "$deb")" \
  "($(($(stat -c %s "$deb") / 1000)) kB) installs with $(grep -c '^Setting up' "$work/apt") packages"
