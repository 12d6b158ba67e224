/* SPDX-License-Identifier: MIT */
#include "accel_test.h"
#include "transport/option.h"

struct values {
	uint64_t size, count;
};

static int parse(const char *text, struct values *values, struct accel_transport_error *error)
{
	const struct accel_option options[] = {
		{ "size", 2, 16, 0, &values->size },
		{ "count", 0, UINT64_MAX, 5, &values->count },
		{ NULL, 0, 0, 0, NULL },
	};

	*values = (struct values){ 4, 100 };
	*error = (struct accel_transport_error){ "" };
	return accel_option_parse(text, options, error);
}

static void what_is_not_given_keeps_its_default(void **state)
{
	struct accel_transport_error error;
	struct values values;

	(void)state;
	assert_int_equal(parse("", &values, &error), 0);
	assert_int_equal(values.size, 4);
	assert_int_equal(values.count, 100);
	assert_int_equal(parse("count=5", &values, &error), 0);
	assert_int_equal(values.size, 4);
	assert_int_equal(values.count, 5);
}

static void options_come_in_any_order(void **state)
{
	struct accel_transport_error error;
	struct values values;

	(void)state;
	assert_int_equal(parse("count=18446744073709551615,size=16", &values, &error), 0);
	assert_int_equal(values.size, 16);
	assert_true(values.count == UINT64_MAX);
	assert_int_equal(parse("size=2,count=0", &values, &error), 0);
	assert_int_equal(values.size, 2);
	assert_int_equal(values.count, 0);
}

static void wrong_text_is_refused_and_named(void **state)
{
	static const struct {
		const char *text, *message;
	} wrong[] = {
		{ "size", "no option \"size\"" },
		{ "size=", "size takes a power of two from 2 to 16" },
		{ "size=3", "size takes a power of two from 2 to 16" },
		{ "size=1", "size takes a power of two from 2 to 16" },
		{ "size=32", "size takes a power of two from 2 to 16" },
		{ "size=0", "size takes a power of two from 2 to 16" },
		{ "size= 4", "size takes a power of two from 2 to 16" },
		{ "size=+4", "size takes a power of two from 2 to 16" },
		{ "size=-4", "size takes a power of two from 2 to 16" },
		{ "size=4k", "size takes a power of two from 2 to 16" },
		{ "size=0x4", "size takes a power of two from 2 to 16" },
		{ "size=4,", "no option \"\"" },
		{ ",size=4", "no option \"\"" },
		{ "size=4,size=4", "size is given twice" },
		{ "sizes=4", "no option \"sizes=4\"" },
		{ "siz=4", "no option \"siz=4\"" },
		{ "Size=4", "no option \"Size=4\"" },
		{ "=4", "no option \"=4\"" },
		{ "size=4,what", "no option \"what\"" },
		{ "count=7", "count takes a multiple of 5 from 0 to 18446744073709551615" },
		{ "count=18446744073709551616", "count takes a multiple of 5 from 0 to" },
	};
	struct accel_transport_error error;
	struct values values;
	size_t i;

	(void)state;
	for (i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		assert_int_equal(parse(wrong[i].text, &values, &error), -EINVAL);
		if (!strstr(error.text, wrong[i].message))
			fail_msg("\"%s\": \"%s\"", wrong[i].text, error.text);
	}
}

static void a_long_text_makes_a_short_message(void **state)
{
	struct accel_transport_error error;
	struct values values;
	char text[5000];

	(void)state;
	memset(text, 'x', sizeof(text) - 1);
	text[sizeof(text) - 1] = '\0';
	assert_int_equal(parse(text, &values, &error), -EINVAL);
	assert_true(strlen(error.text) < 100);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_is_not_given_keeps_its_default),
		cmocka_unit_test(options_come_in_any_order),
		cmocka_unit_test(wrong_text_is_refused_and_named),
		cmocka_unit_test(a_long_text_makes_a_short_message),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
