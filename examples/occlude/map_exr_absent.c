/* SPDX-License-Identifier: MIT
 *
 * In place of map_exr.cpp where OpenEXR was not found.
 */
#include "map_format.h"

bool map_read_exr(const map_reader *r, map_file *out_map)
{
    (void)out_map;
    return map_fail(r, "this build reads no OpenEXR: it was made without the library");
}
