/* SPDX-License-Identifier: MIT
 *
 * PFM (P. Debevec): a line "Pf" or "PF" for one channel or three, a line with the size, a line with a number whose sign
 * tells the byte order, then floats from the bottom row to the top.
 */
#include "map_format.h"

#include <stdlib.h>
#include <string.h>

bool map_read_pfm(const map_reader *r, map_file *out_map)
{
    char letter, end, scale[32];
    long long width, height;
    /* The widths keep every number within its type; one whitespace character ends the header. The scale is no number to
     * scanf, which would want the host's decimal comma. */
    if (fscanf(r->file, "P%c %9lld %9lld %31[-+.0-9eE]%c", &letter, &width, &height, scale, &end) != 5 ||
        (end != '\n' && end != ' ' && end != '\r') || strcspn(scale, "123456789") >= strcspn(scale, "eE"))
        return map_fail(r, "a damaged PFM header");
    const int channels = letter == 'F' ? 3 : 1;
    if (!map_allocate(r, width, height, channels, out_map))
        return false;
    const size_t row = (size_t)width * (size_t)channels;
    uint8_t *bytes = map_read_rest(r, row * (size_t)height * 4);
    for (size_t y = 0; bytes && y < (size_t)height; ++y)
        for (size_t x = 0; x < row; ++x)
            out_map->values[y * row + x] =
                map_decode(bytes + 4 * (((size_t)height - 1 - y) * row + x), MAP_FLOAT, 4, scale[0] != '-');
    free(bytes);
    return bytes != NULL;
}
