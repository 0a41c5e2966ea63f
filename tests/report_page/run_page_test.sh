#!/usr/bin/env bash
# run_page_test.sh GENU ROOT: page_test.mjs, where there is a node to run it.
set -euo pipefail
command -v node >/dev/null || { echo "skipped: node is not installed"; exit 77; }
exec node "$(dirname "${BASH_SOURCE[0]}")/page_test.mjs" "$@"
