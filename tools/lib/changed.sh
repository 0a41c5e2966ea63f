# Sourced by tools/lint and tools/reached: which files a branch has changed. Call them in the folder of the checkout.

# Where the branch left origin/main or main; fails on main itself, or where git knows neither.
branch_point() {
  local main found
  for main in origin/main main; do
    git rev-parse -q --verify "$main^{commit}" >/dev/null 2>&1 || continue
    found=$(git merge-base HEAD "$main" 2>/dev/null) || continue
    [ "$found" = "$(git rev-parse HEAD)" ] || { echo "$found"; return 0; }
  done
  return 1
}

# changed_since COMMIT PATHSPEC...: what differs from it in the working tree, and what git does not know yet.
changed_since() {
  git diff --name-only --diff-filter=d "$1" -- "${@:2}"
  git ls-files --others --exclude-standard -- "${@:2}"
}
