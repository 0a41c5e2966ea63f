#!/usr/bin/env bash
# check_scripts.sh ROOT: every script of .ci and tools may be executed, and bash can read it.
set -euo pipefail
found=0
for file in "$1"/.ci/* "$1"/tools/*; do
  [ -f "$file" ] && [[ $file != *.txt ]] || continue
  found=$((found + 1))
  [ -x "$file" ] || { echo "$file: is not executable"; exit 1; }
  [ "$(head -1 "$file")" = '#!/usr/bin/env bash' ] || { echo "$file: does not begin with #!/usr/bin/env bash"; exit 1; }
  bash -n "$file"
done
[ "$found" -gt 0 ] || { echo "no scripts under $1"; exit 1; }
