/* SPDX-License-Identifier: MIT
 *
 * A stranger's program: uses the library through the public header alone, in the common subset of C and C++.
 */
#include <glssao/glssao.h>
#include <stdio.h>

static void *no_functions(const char *name, void *user)
{
    (void)name;
    (void)user;
    return 0;
}

int main(void)
{
    static glssao_config config; /* zero, in C and in C++ */
    config.load = no_functions;
    config.width = config.height = 64;
    glssao_effect *effect = 0;
    glssao_result result = glssao_create(&config, &effect);
    uint32_t wanted = GLSSAO_VERSION_MAJOR << 16 | GLSSAO_VERSION_MINOR << 8 | GLSSAO_VERSION_PATCH;
    printf("glssao %x: %s\n", (unsigned)glssao_version(), glssao_result_string(result));
    return result == GLSSAO_UNSUPPORTED_CONTEXT && !effect && glssao_version() == wanted ? 0 : 1;
}
