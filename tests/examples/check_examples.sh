#!/usr/bin/env bash
# check_examples.sh BIN SOURCE: runs the programs of examples/ in BIN on scenes of SOURCE.
set -euo pipefail
bin=$1 source=$2
fail() { echo "examples: $*" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
knee=$source/meshes/dortmans1984/scene.toml

# column FILE NAME: a column of a CSV without quotes.
column() {
  awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i; if (!c) exit 1 } NR > 1 { print $c }' "$1"
}
run() { "$bin/genu" run "$1" --no-report --quiet --out "$2"; }
run "$knee" "$work/knee"

# The middle of five values is the file's own.
"$bin/example_parameter_loop" "$knee" AAC.stiffness AAC.force_N 5 > "$work/loop.csv" || fail "parameter_loop"
[ "$(wc -l < "$work/loop.csv")" -eq 6 ] || fail "parameter_loop printed no 5 rows"
largest=$(column "$work/knee/results.csv" AAC.force_N | sort -g | tail -1)
[ "$(sed -n 4p "$work/loop.csv" | cut -d, -f2)" = "$largest" ] || fail "parameter_loop: not $largest in $(sed -n 4p "$work/loop.csv")"
[ "$(cut -d, -f2 "$work/loop.csv" | sort -u | wc -l)" -eq 6 ] || fail "parameter_loop: the number changes nothing"

"$bin/example_own_law" "$knee" AAC AAC.force_N > "$work/law.csv" || fail "own_law"
cmp <(column "$work/law.csv" 'in the file') <(column "$work/knee/results.csv" AAC.force_N) || fail "own_law: the file's law"
! cmp -s <(column "$work/law.csv" 'own law') <(column "$work/law.csv" 'in the file') || fail "own_law changes nothing"

"$bin/example_own_loads" "$knee" femur knee.y_mm > "$work/loads.csv" || fail "own_loads"
{ cat "$knee"; printf '\n[load.own]\nbody = "femur"\nforce = [0, 10, 0]\n'; } > "$work/loaded.toml"
run "$work/loaded.toml" "$work/loaded"
[ "$(tail -1 "$work/loads.csv" | cut -d, -f2)" = "$(column "$work/loaded/results.csv" knee.y_mm | sed -n 1p)" ] ||
  fail "own_loads differs from a scene with that load"

bone=$source/tests/examples/hanging_bone.toml
"$bin/example_residual" "$bone" > "$work/residual.csv" 2> "$work/said" || fail "residual: $(cat "$work/said")"
run "$bone" "$work/bone"
for name in flexion adduction rotation x y z; do
  case $name in x | y | z) unit=mm si=1000 ;; *) unit=deg si=57.29577951308232 ;; esac
  own=$(grep "^joint.$name," "$work/residual.csv" | cut -d, -f2)
  told=$(column "$work/bone/results.csv" "joint.${name}_$unit" | sed -n 1p)
  awk -v a="$own" -v b="$told" -v s="$si" 'BEGIN { d = a * s - b; exit !(d < 1e-9 && d > -1e-9) }' ||
    fail "residual: $name is $own, results.csv has $told $unit"
done

code=0
"$bin/example_residual" "$knee" > "$work/out" 2> "$work/said" || code=$?
[ "$code" -eq 2 ] && grep -q "is rigid" "$work/said" || fail "residual takes a scene with rigid contacts"
echo "four examples, with the program's numbers"
