#!/usr/bin/env bash
# check_consumer.sh BUILD CMAKE CXX [PYTHON]: installs BUILD into a folder of its own and lets a project find it there, which must
# get by with genu's headers, and find what the installed program finds. So must the Python package, where it is built.
set -euo pipefail
build=$1 cmake=$2 cxx=$3 python=${4-}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
fail() { echo "install_consumer: $*" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$work/first" > "$work/log" || { cat "$work/log"; fail "cmake --install"; }
mv "$work/first" "$work/prefix" # an installation may be moved

# What headers include: themselves, the standard library (a word without . or /).
foreign=$(grep -rhoE '^ *# *include *[<"][^>"]+[>"]' "$work/prefix/include" | sed -E 's/.*[<"]([^>"]+)[>"]/\1/' | sort -u |
          grep -vE '^(genu/api/[a-z_]+\.h|[a-z_]+)$' || true)
[ -z "$foreign" ] || fail "installed headers include $foreign"
[ "$(cd "$work/prefix/include" && find . -type f | LC_ALL=C sort | xargs)" = \
  "./genu/api/meshes.h ./genu/api/problem.h ./genu/api/results.h ./genu/api/scene.h ./genu/api/table.h ./genu/genu.h" ] ||
  fail "not the API is installed: $(cd "$work/prefix/include" && find . -type f | xargs)"
for file in bin/genu lib/libgenu.so lib/cmake/genu/genuConfig.cmake lib/cmake/genu/genuConfigVersion.cmake \
            share/doc/genu/LICENSE share/doc/genu/copyright share/genu/meshes/dortmans1984/scene.toml; do
  [ -e "$work/prefix/$file" ] || fail "$file is not installed"
done
grep -q 'three.js authors' "$work/prefix/share/doc/genu/copyright" || fail "copyright lacks three.js"
! grep -rlF "$build" "$work/prefix/lib/cmake" || fail "the package knows where it was built"

"$cmake" -S "$here/consumer" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_CXX_COMPILER_LAUNCHER= > "$work/log" 2>&1 || { cat "$work/log"; fail "the consumer cannot be configured"; }
"$cmake" --build "$work/build" > "$work/log" 2>&1 || { cat "$work/log"; fail "the consumer cannot be built"; }
read_headers=$(ninja -C "$work/build" -t deps | grep -E '^ +/' | grep -vE '^ +/usr/(include/(c\+\+|x86_64-linux-gnu|[a-z0-9]+-linux-gnu|linux|asm-generic|bits|sys|gnu)/|include/[a-z0-9_-]+\.h|lib/gcc)' |
               grep -vF "$work/prefix/include/genu/" | grep -vF "$here/consumer/" || true)
[ -z "$read_headers" ] || fail "compiling the consumer read $read_headers"

scene=$work/prefix/share/genu/meshes/dortmans1984/scene.toml
"$work/prefix/bin/genu" run "$scene" --no-report --quiet --out "$work/out" || fail "the installed program"
"$work/build/consumer" "$scene" knee.adduction_deg > "$work/found" || fail "the consumer"
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "knee.adduction_deg") c = i } NR > 1 { print $c }' "$work/out/results.csv" > "$work/told"
[ "$(wc -l < "$work/told")" -eq 71 ] || fail "results.csv has not 71 rows"
cmp "$work/found" "$work/told" || fail "the library and the program differ"
by="the library"
if [ -n "$python" ]; then
  PYTHONPATH=$work/prefix/lib/python3/dist-packages "$python" -c 'import sys, genu
for value in genu.load(sys.argv[1]).run()[sys.argv[2]]: print("%.17g" % value)' "$scene" knee.adduction_deg > "$work/found" ||
    fail "the Python package"
  cmp "$work/found" "$work/told" || fail "the Python package and the program differ"
  by="the library and the Python package"
fi
echo "71 poses by $by as by the program, to the last digit"
