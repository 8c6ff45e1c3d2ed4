/* SPDX-License-Identifier: MIT
 *
 * cmocka, and tests that register themselves, so that no list of them can miss one:
 *
 *     TEST(doubles_are_even)
 *     {
 *         assert_int_equal(2 * 3 % 2, 0);
 *     }
 *
 *     TEST_MAIN(NULL, NULL, NULL)
 *
 * Inside a test, `state` is cmocka's.
 */
#pragma once

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Calls release(what) when the running test ends, passed or failed; the latest comes first. */
void test_release_later(void (*release)(void *what), void *what);
/* The cmocka teardown that does so. A teardown for TEST_WITH calls it. */
int test_release(void **state);

/* Ends the variable with its block, for kinds of which there is a test_end_KIND: SCOPED(memory) float *a = ...; */
#define SCOPED(kind) __attribute__((cleanup(test_end_##kind)))
/* `at` points to a pointer. */
void test_end_memory(const void *at);
/* Makes a test_end_KIND for pointers, which hands them to `release`. */
#define SCOPED_BY(kind, type, release)                                                                                 \
    static inline void test_end_##kind(type **at)                                                                      \
    {                                                                                                                  \
        release(*at);                                                                                                  \
    }

/* A test with a teardown of its own, and with the group's *state as `given`. */
#define TEST_OF(name, type, given, teardown)                                                                           \
    static void name(type *given);                                                                                     \
    static void name##_runs(void **state)                                                                              \
    {                                                                                                                  \
        name((type *)*state);                                                                                          \
    }                                                                                                                  \
    __attribute__((constructor)) static void name##_registers(void)                                                    \
    {                                                                                                                  \
        test_register(#name, name##_runs, teardown);                                                                   \
    }                                                                                                                  \
    static void name(__attribute__((unused)) type *given)
#define TEST_WITH(name, teardown) TEST_OF(name, void, state, teardown)
#define TEST(name) TEST_WITH(name, test_release)

void test_register(const char *name, CMUnitTestFunction test, CMFixtureFunction teardown);

/* Runs the tests of the program in the order of their definition, between the group's setup and teardown, and returns
 * the number of those that failed. `group` is a name for the output, or NULL. */
int test_run(const char *group, CMFixtureFunction setup, CMFixtureFunction teardown);
/* The program's main function, which does that alone. */
#define TEST_MAIN(group, setup, teardown)                                                                              \
    int main(void)                                                                                                     \
    {                                                                                                                  \
        return test_run(group, setup, teardown);                                                                       \
    }
