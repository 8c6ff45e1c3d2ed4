/* SPDX-License-Identifier: MIT */
#include <stdint.h>

uint32_t plugin_version(void);

int main(void)
{
    return plugin_version() != 0 ? 0 : 1;
}
