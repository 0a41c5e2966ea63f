#!/usr/bin/env bash
# run_page_test.sh TEST GENU ROOT: a test of the page, where there is a node to run it.
set -euo pipefail
command -v node >/dev/null || { echo "skipped: node is not installed"; exit 77; }
exec node "$(dirname "${BASH_SOURCE[0]}")/$1" "${@:2}"
