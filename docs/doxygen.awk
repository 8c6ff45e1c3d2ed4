# SPDX-License-Identifier: MIT
# The public header's plain comments as Doxygen's: before a declaration, behind a member, or behind the opening brace
# of a struct or enum. Members declared together are declared one by one, so that each has the comment. Rules of
# dashes stay plain.
pending != "" { # the rest of a comment behind several members
    rest = rest "\n" $0
    if (/\*\//) { split_members(first, rest); pending = "" }
    next
}
/^\/\* SPDX/ { print "/** @file"; next }
/^\/\* ----/ { print; next }
/^\/\* / { sub(/^\/\* /, "/** "); print; heads_defines = $0; next }
/^#define GLSSAO_[A-Z_]+ [0-9]+$/ && heads_defines { # one comment may head several
    if (was_define) print heads_defines
    was_define = 1
    print
    next
}
{ was_define = 0; heads_defines = "" }
/(struct|enum) [a-z_]+ \{ *\/\* .*\*\/$/ {
    comment = $0
    sub(/.*\/\* /, "/** ", comment)
    sub(/ *\/\* .*/, "")
    print comment
    print
    next
}
/^ +[a-z0-9_]+ [A-Za-z_]+(, [A-Za-z_]+)+; *\/\* / {
    first = $0
    sub(/ *\/\* .*/, "", first)
    rest = $0
    sub(/.*\/\* /, "/**< ", rest)
    if (/\*\//) split_members(first, rest)
    else pending = "open"
    next
}
{ sub(/\/\* /, "/**< "); print }

function split_members(declaration, comment,    type, names, n, i) {
    sub(/;$/, "", declaration)
    match(declaration, /^ +[a-z0-9_]+ /)
    type = substr(declaration, 1, RLENGTH)
    n = split(substr(declaration, RLENGTH + 1), names, /, /)
    for (i = 1; i <= n; i++)
        print type names[i] "; " comment
}
