/* SPDX-License-Identifier: MIT
 *
 * A shared library that keeps the static glssao to itself.
 */
#include <glssao/glssao.h>
#include <stddef.h>

uint32_t plugin_version(void);

uint32_t plugin_version(void)
{
    glssao_effect *effect = NULL;
    return glssao_create(NULL, &effect) == GLSSAO_INVALID_ARGUMENT ? glssao_version() : 0;
}
