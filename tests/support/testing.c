/* SPDX-License-Identifier: MIT */
#include "testing.h"

enum { MOST_TESTS = 64 };

static struct CMUnitTest tests[MOST_TESTS];
static size_t count;

void test_register(const char *name, CMUnitTestFunction test, CMFixtureFunction teardown)
{
    if (count == MOST_TESTS) {
        fprintf(stderr, "more than %d tests\n", MOST_TESTS);
        exit(1);
    }
    tests[count++] = (struct CMUnitTest){.name = name, .test_func = test, .teardown_func = teardown};
}

int test_run(const char *group, CMFixtureFunction setup, CMFixtureFunction teardown)
{
    return _cmocka_run_group_tests(group ? group : "tests", tests, count, setup, teardown);
}
