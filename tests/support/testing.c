/* SPDX-License-Identifier: MIT */
#include "testing.h"

enum { MOST_TESTS = 64, MOST_OWNED = 64 };

static struct CMUnitTest tests[MOST_TESTS];
static size_t count;

static struct {
    void (*release)(void *what);
    void *what;
} owned[MOST_OWNED];
static size_t owned_count;

void test_release_later(void (*release)(void *what), void *what)
{
    assert_in_range(owned_count, 0, MOST_OWNED - 1);
    owned[owned_count].release = release;
    owned[owned_count++].what = what;
}

int test_release(void **state)
{
    (void)state;
    for (; owned_count > 0; --owned_count)
        owned[owned_count - 1].release(owned[owned_count - 1].what);
    return 0;
}

void test_end_memory(const void *at)
{
    void *memory;
    memcpy(&memory, at, sizeof memory);
    free(memory);
}

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
