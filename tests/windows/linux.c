/* SPDX-License-Identifier: MIT
 *
 * windows_reference FILE: the pictures of pictures.c on this system, for the Windows run to compare with.
 */
#include "context.h"
#include "gl.h"
#include "pictures.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: windows_reference FILE\n");
        return 2;
    }
    const context_options options = {.kind = CONTEXT_EGL};
    char error[512];
    context *c = context_create(&options, error, sizeof error);
    if (!c || !gl_load(context_load, c, error, sizeof error)) {
        fprintf(stderr, "%s\n", error);
        return 1;
    }
    printf("%s\n", context_description(c));
    const pictures_host host = {.load = context_load, .load_user = c};
    const bool ok = pictures_check(&host, argv[1], false);
    context_destroy(c);
    return ok ? 0 : 1;
}
