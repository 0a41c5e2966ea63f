#!/usr/bin/env bash
# check_scripts.sh ROOT: every script of .ci and tools may be executed, and its interpreter can read it. No script lets a reader end
# before its writer (| grep -q, | head): with pipefail the writer's SIGPIPE now and then is the whole command's failure.
set -euo pipefail
found=0
for file in "$1"/.ci/* "$1"/tools/*; do
  [ -f "$file" ] && [[ $file != *.txt ]] || continue
  found=$((found + 1))
  [ -x "$file" ] || { echo "$file: is not executable"; exit 1; }
  case $(head -1 "$file") in
    '#!/usr/bin/env bash') bash -n "$file" ;;
    '#!/usr/bin/env node') node --check "$file" ;;
    '#!/usr/bin/env python3') python3 -c 'import ast, sys; ast.parse(open(sys.argv[1]).read())' "$file" ;;
    *) echo "$file: begins with none of #!/usr/bin/env bash, node and python3"; exit 1 ;;
  esac
done
mapfile -t scripts < <(grep -rlE '^#!.*bash' "$1"/.ci "$1"/tools "$1"/tests --include='*' --exclude='*.cpp')
if grep -nE '^[^#]*[^|]\|[[:space:]]*(grep -[a-zA-Z]*[qm]|head([[:space:]]|$))' "${scripts[@]}"; then
  echo "a reader that ends before its writer: write grep ... >/dev/null, sed -n 1p"
  exit 1
fi
[ "$found" -gt 0 ] || { echo "no scripts under $1"; exit 1; }
