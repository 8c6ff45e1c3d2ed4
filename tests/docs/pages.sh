# SPDX-License-Identifier: MIT
# Sourced by the checks of the docs: find_pages fills `pages` with every Markdown page below the current folder that
# belongs to the repository.
find_pages() {
    mapfile -t pages < <(find . -name '*.md' -not -path './build*' -not -path './out/*' -not -path './bare-machine-out/*' -not -path './.*' | sed 's|^\./||' | sort)
    [ "${#pages[@]}" -gt 10 ] || { echo "found ${#pages[@]} pages only" >&2; exit 1; }
}
