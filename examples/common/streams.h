/* SPDX-License-Identifier: MIT
 *
 * Standard input, output and error, as a program finds them.
 */
#pragma once

/* Call it first in main. Streams that are closed become ones that fail, so that no file of the program's takes their
 * number and then their text. A limit on the size of files does not kill it. When the program exits and what it printed
 * could not be written, it says so in a line on stderr that begins with `program`, and exits with `code`. */
void streams_guard(const char *program, int code);
