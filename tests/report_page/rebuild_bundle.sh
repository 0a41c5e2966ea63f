#!/usr/bin/env bash
# rebuild_bundle.sh ROOT: bundles the page of report.html anew, from the lock file's packages, and compares every byte with
# the bundle in the tree.
set -euo pipefail
command -v npm >/dev/null || { echo "skipped: npm is not installed"; exit 77; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cp -r "$1/src/report_page/src" "$1"/src/report_page/{build.mjs,package.json,package-lock.json} "$out"
cd "$out"
if ! npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 > log 2>&1; then
  cat log
  if grep -qE 'ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ENETUNREACH' log; then
    echo "skipped: the registry of npm cannot be reached"
    exit 77
  fi
  exit 1
fi
node build.mjs made
cmp made/page.html "$1/src/report_page/bundle/page.html" || {
  echo "bundle/page.html is not what its sources make: run 'npm ci && npm run build' in src/report_page"
  exit 1
}
echo "the same $(wc -c < made/page.html) bytes"
