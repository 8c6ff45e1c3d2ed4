/* SPDX-License-Identifier: MIT
 *
 * Sections of the report for people.
 */
#ifndef GLSSAO_BENCH_DOCUMENT_H
#define GLSSAO_BENCH_DOCUMENT_H

#include "results.h"

#include <stdio.h>

/* Which blur is better, by how much, and where. */
void document_blur(FILE *f, const results *r);

/* What each choice costs, and what one layer can give. Needs r->split. */
void document_split(FILE *f, const results *r);

#endif
