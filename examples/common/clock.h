/* SPDX-License-Identifier: MIT
 *
 * Times in milliseconds.
 */
#pragma once

double clock_wall_ms(void); /* since a fixed moment; never goes backwards */
double clock_cpu_ms(void);  /* processor time of all threads of the process */
