#!/usr/bin/env bash
# check_deb.sh BUILD CPACK VERSION: makes the .deb of BUILD, looks at what it depends on, runs what is in it; with CI=true and as
# root it is installed for real, run from /usr/bin, and removed.
set -euo pipefail
build=$1 cpack=$2 version=$3
fail() { echo "install_deb: $*" >&2; exit 1; }
for program in dpkg-deb dpkg-shlibdeps file; do
  command -v "$program" > /dev/null || { echo "skipped: no $program"; exit 77; }
done

work=$(mktemp -d)
installed=no
cleanup() {
  [ "$installed" = no ] || dpkg --purge genu > /dev/null
  rm -rf "$work"
}
trap cleanup EXIT
"$cpack" --config "$build/CPackConfig.cmake" -B "$work" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip > "$work/log" 2>&1 ||
  { cat "$work/log"; fail "cpack"; }
deb=$(echo "$work"/genu_*.deb)
[ -f "$deb" ] || fail "cpack made no genu_*.deb"
[ "$(dpkg-deb -f "$deb" Version)" = "$version" ] || fail "version $(dpkg-deb -f "$deb" Version)"
depends=$(dpkg-deb -f "$deb" Depends)
for library in libc6 libstdc++6 libfcl libassimp libtbb libfmt libsundials; do
  [[ $depends == *"$library"* ]] || fail "does not depend on $library: $depends"
done
[[ $depends != *-dev* ]] || fail "needs what only a compiler needs: $depends"

# check_program PROGRAM SHARE: version, a shipped scene, the catalogue that was shipped with it.
check_program() {
  [[ $("$1" --version) == *"genu $version"* ]] || fail "$1 --version"
  "$1" run "$2/genu/meshes/dortmans1984/scene.toml" --quiet --out "$work/out" || fail "$1 run"
  [ "$(wc -l < "$work/out/results.csv")" -eq 72 ] || fail "results.csv has not 71 rows"
  "$1" hard-cases --case ball_on_a_ball --cases "$2/genu/hard_cases" > "$work/log" 2>&1 ||
    { cat "$work/log"; fail "$1 hard-cases"; }
}
dpkg-deb -x "$deb" "$work/root"
check_program "$work/root/usr/bin/genu" "$work/root/usr/share"
ldd "$work/root/usr/lib/libgenu.so" > "$work/log"
! grep 'not found' "$work/log" || fail "libgenu.so misses a library"

how=unpacked
if [ "$(id -u)" -eq 0 ] && [ "${CI-}" = true ] && ! dpkg-query -W genu > /dev/null 2>&1; then
  installed=yes
  dpkg -i "$deb" > "$work/log" 2>&1 || { cat "$work/log"; fail "dpkg -i"; }
  check_program /usr/bin/genu /usr/share
  ldconfig -p | grep 'libgenu\.so' > /dev/null || fail "the loader does not know libgenu.so"
  dpkg --purge genu > "$work/log" 2>&1 || { cat "$work/log"; fail "dpkg --purge"; }
  installed=no
  [ ! -e /usr/bin/genu ] || fail "dpkg --purge left /usr/bin/genu"
  how="installed and removed"
fi
echo "$(basename "$deb"): $(($(stat -c %s "$deb") / 1000)) kB, $how; depends on $depends"
