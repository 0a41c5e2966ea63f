#!/usr/bin/env bash
# moving_picture_test.sh GENU ROOT: runs tools/moving-picture for a shipped scene with few frames. That picture and the
# one of README.md move in every frame, and repeat every 6 s. Skipped (77) where a program is missing.
set -euo pipefail
genu=$1 root=$2
for program in node chromium img2webp webpinfo; do
  command -v $program >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

fail() { echo "FAILED: $*"; exit 1; }

"$root/tools/moving-picture" --scene meshes/leskovar2019/scene-bones.toml --frames 6 "$genu" "$out/bones.webp"

# frames FILE: "720 x 540, for ever, 6 frames, 6000 ms". img2webp drops a frame that equals the one before it.
frames() {
  webpinfo "$1" >"$out/info"
  grep -q 'No error detected' "$out/info" || fail "$1 is no WebP"
  awk '/Canvas size/ {canvas = $3 " x " $5} /Loop count/ {loops = $4} /Duration:/ {++n; all += $2}
       END {print canvas ", " (loops == 0 ? "for ever" : "once") ", " n " frames, " all " ms"}' "$out/info"
}

# Rows at 0, 1/4, 3/4 and 1 of the way, and two of them on the way back.
frames "$out/bones.webp" | tee "$out/said"
grep -qx '720 x 540, for ever, 6 frames, 6000 ms' "$out/said" || fail "not what six frames should be"

shown=$(grep -o 'docs/[a-z-]*\.webp' "$root/README.md" | sed -n 1p)
[ -n "$shown" ] || fail "README.md shows no moving picture"
[ "$(grep -n "$shown" "$root/README.md" | sed -n 1p | cut -d: -f1)" -le 30 ] || fail "$shown is not on the first screen of README.md"
[ "$(stat -c %s "$root/$shown")" -lt 1000000 ] || fail "$shown has more than 1 MB"
frames "$root/$shown" | tee "$out/said"
grep -Eqx '720 x 540, for ever, ([6-9][0-9]|1[0-9][0-9]) frames, 6000 ms' "$out/said" ||
  fail "$shown is not smooth"

for wrong in "--frames 3" "--frames x" "--speed 2"; do
  code=0
  # shellcheck disable=SC2086  # two words
  "$root/tools/moving-picture" $wrong "$genu" "$out/none.webp" 2>"$out/said" || code=$?
  [ "$code" = 2 ] && [ -s "$out/said" ] && [ ! -e "$out/none.webp" ] || fail "$wrong: exit code $code"
done
