/* SPDX-License-Identifier: MIT
 *
 * For the Python module, which compares its own idea of each struct with this.
 */
#include "map_file.h"
#include "occlude.h"

#include <string.h>

size_t occlude_struct_size(const char *name);

size_t occlude_struct_size(const char *name)
{
    static const struct {
        const char *name;
        size_t size;
    } structs[] = {
#define SIZE(name) {#name, sizeof(name)},
#include "struct_names.h" /* generated from the headers */
    };
    for (size_t i = 0; i < sizeof structs / sizeof *structs; ++i)
        if (strcmp(structs[i].name, name) == 0)
            return structs[i].size;
    return 0;
}
