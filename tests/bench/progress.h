/* SPDX-License-Identifier: MIT
 *
 * One line on stderr that tells what is going on; nothing where stderr is no terminal.
 */
#ifndef GLSSAO_BENCH_PROGRESS_H
#define GLSSAO_BENCH_PROGRESS_H

#ifdef __GNUC__
__attribute__((format(printf, 1, 2)))
#endif
void progress_show(const char *format, ...);

void progress_clear(void);

#endif
