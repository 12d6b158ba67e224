/* SPDX-License-Identifier: MIT */
/* The configuration space as a host finds it. */
#include <linux/pci_regs.h>

#include "accel_test.h"
#include "vboard/pci/config.h"

static struct vboard_config config;

static int setup(void **state)
{
	(void)state;
	vboard_config_reset(&config);
	return 0;
}

static uint32_t read(uint32_t address, int bytes)
{
	return vboard_config_read(&config, address, bytes);
}

static void write(uint32_t address, uint32_t value, int bytes)
{
	vboard_config_write(&config, address, value, bytes);
}

static void a_driver_finds_the_ids_and_an_msi_capability(void **state)
{
	uint32_t capability;

	(void)state;
	assert_int_equal(read(PCI_VENDOR_ID, 4), 0x474c10ee);
	assert_int_equal(read(PCI_CLASS_REVISION, 4) >> 8, 0x120000);
	assert_int_equal(read(PCI_SUBSYSTEM_VENDOR_ID, 4), 0x534f10ee);
	assert_int_equal(read(PCI_HEADER_TYPE, 1), PCI_HEADER_TYPE_NORMAL);
	assert_int_equal(read(PCI_INTERRUPT_PIN, 1), 1);
	assert_true(read(PCI_STATUS, 2) & PCI_STATUS_CAP_LIST);
	capability = read(PCI_CAPABILITY_LIST, 1);
	assert_int_equal(read(capability, 1), PCI_CAP_ID_MSI);
	assert_int_equal(read(capability + PCI_CAP_LIST_NEXT, 1), 0);
	assert_int_equal(read(capability + PCI_MSI_FLAGS, 2), PCI_MSI_FLAGS_64BIT);
}

static void a_bar_tells_its_size_and_there_are_two(void **state)
{
	static const uint32_t sizes[] = { 0x10000, 0x1000, 0, 0, 0, 0 };
	uint32_t i, bar;

	(void)state;
	for (i = 0; i < 6; i++) {
		bar = PCI_BASE_ADDRESS_0 + 4 * i;
		assert_int_equal(read(bar, 4), 0);
		write(bar, 0xffffffff, 4);
		assert_int_equal(read(bar, 4), -sizes[i]);
	}
	write(PCI_ROM_ADDRESS, 0xffffffff, 4);
	assert_int_equal(read(PCI_ROM_ADDRESS, 4), 0);
	/* QEMU asks here for a seventh. */
	write(PCI_CARDBUS_CIS, 0xffffffff, 4);
	assert_int_equal(read(PCI_CARDBUS_CIS, 4), 0);
}

static void a_bar_decodes_its_own_bytes_when_memory_is_enabled(void **state)
{
	uint32_t offset = 0;

	(void)state;
	write(PCI_BASE_ADDRESS_0, 0xfeb00000, 4);
	write(PCI_BASE_ADDRESS_1, 0xfeb10000, 4);
	assert_int_equal(vboard_config_find(&config, 0xfeb00000, 4, &offset), -1);
	write(PCI_COMMAND, PCI_COMMAND_MEMORY, 2);
	assert_int_equal(vboard_config_find(&config, 0xfeb00000, 4, &offset), 0);
	assert_int_equal(offset, 0);
	assert_int_equal(vboard_config_find(&config, 0xfeb0fffc, 4, &offset), 0);
	assert_int_equal(offset, 0xfffc);
	assert_int_equal(vboard_config_find(&config, 0xfeb0fffc, 8, &offset), -1);
	assert_int_equal(vboard_config_find(&config, 0xfeb10ffc, 4, &offset), 1);
	assert_int_equal(offset, 0xffc);
	assert_int_equal(vboard_config_find(&config, 0xfeb11000, 4, &offset), -1);
	assert_int_equal(vboard_config_find(&config, 0xfeafffff, 1, &offset), -1);
	assert_int_equal(vboard_config_find(&config, 0x1feb00000, 4, &offset), -1);
	assert_int_equal(vboard_config_find(&config, UINT64_MAX, 4, &offset), -1);
	assert_int_equal(vboard_config_find(&config, 0xfeb00000, UINT32_MAX, &offset), -1);
}

static void only_what_may_be_written_changes(void **state)
{
	struct vboard_config before;
	uint32_t address;

	(void)state;
	before = config;
	for (address = 0; address < VBOARD_CONFIG_BYTES; address++)
		write(address, ~read(address, 1), 1);
	for (address = 0; address < VBOARD_CONFIG_BYTES; address++)
		assert_int_equal(config.bytes[address] ^ before.bytes[address],
				 config.writable[address]);
	assert_int_equal(read(PCI_VENDOR_ID, 4), 0x474c10ee);
	assert_int_equal(read(PCI_COMMAND, 2),
			 PCI_COMMAND_MEMORY | PCI_COMMAND_MASTER | PCI_COMMAND_INTX_DISABLE);
}

static void an_access_that_does_not_fit_reads_ones_and_writes_nothing(void **state)
{
	static const struct {
		uint32_t address;
		int bytes;
	} wrong[] = {
		{ 256, 1 },        { 255, 2 },        { 253, 4 },
		{ 0, 0 },          { 0, 3 },          { 0, 8 },
		{ 0, -4 },         { UINT32_MAX, 4 }, { UINT32_MAX - 1, 2 },
		{ 0x7fffffff, 1 },
	};
	struct vboard_config before;
	size_t i;

	(void)state;
	before = config;
	for (i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		assert_int_equal(read(wrong[i].address, wrong[i].bytes), UINT32_MAX);
		write(wrong[i].address, 0xffffffff, wrong[i].bytes);
		assert_memory_equal(&before, &config, sizeof(config));
	}
}

static void a_message_goes_where_the_host_said(void **state)
{
	uint32_t msi = read(PCI_CAPABILITY_LIST, 1);
	uint64_t address;
	uint16_t data;

	(void)state;
	assert_false(vboard_config_msi(&config));
	write(msi + PCI_MSI_ADDRESS_LO, 0xfee01007, 4);
	write(msi + PCI_MSI_ADDRESS_HI, 0x12, 4);
	write(msi + PCI_MSI_DATA_64, 0x4321, 2);
	write(msi + PCI_MSI_FLAGS, 0xffff, 2);
	assert_int_equal(read(msi + PCI_MSI_FLAGS, 2), PCI_MSI_FLAGS_64BIT | PCI_MSI_FLAGS_ENABLE);
	assert_true(vboard_config_msi(&config));
	vboard_config_message(&config, &address, &data);
	assert_int_equal(address, 0x12fee01004);
	assert_int_equal(data, 0x4321);
}

static void the_pin_is_for_hosts_that_take_no_messages(void **state)
{
	uint32_t msi = read(PCI_CAPABILITY_LIST, 1);

	(void)state;
	assert_true(vboard_config_intx(&config, true));
	assert_true(read(PCI_STATUS, 2) & PCI_STATUS_INTERRUPT);
	write(PCI_COMMAND, PCI_COMMAND_INTX_DISABLE, 2);
	assert_false(vboard_config_intx(&config, true));
	assert_true(read(PCI_STATUS, 2) & PCI_STATUS_INTERRUPT);
	write(PCI_COMMAND, 0, 2);
	assert_true(vboard_config_intx(&config, false));
	assert_false(read(PCI_STATUS, 2) & PCI_STATUS_INTERRUPT);
	write(msi + PCI_MSI_FLAGS, PCI_MSI_FLAGS_ENABLE, 2);
	assert_false(vboard_config_intx(&config, true));
}

static void a_reset_turns_everything_off(void **state)
{
	uint32_t msi = read(PCI_CAPABILITY_LIST, 1);

	(void)state;
	write(PCI_COMMAND, 0xffff, 2);
	write(PCI_BASE_ADDRESS_0, 0xfeb00000, 4);
	write(msi + PCI_MSI_FLAGS, PCI_MSI_FLAGS_ENABLE, 2);
	assert_true(vboard_config_bus_master(&config));
	vboard_config_reset(&config);
	assert_int_equal(read(PCI_COMMAND, 2), 0);
	assert_int_equal(read(PCI_BASE_ADDRESS_0, 4), 0);
	assert_false(vboard_config_bus_master(&config));
	assert_false(vboard_config_msi(&config));
}

#define config_test(name) cmocka_unit_test_setup(name, setup)

int main(void)
{
	const struct CMUnitTest tests[] = {
		config_test(a_driver_finds_the_ids_and_an_msi_capability),
		config_test(a_bar_tells_its_size_and_there_are_two),
		config_test(a_bar_decodes_its_own_bytes_when_memory_is_enabled),
		config_test(only_what_may_be_written_changes),
		config_test(an_access_that_does_not_fit_reads_ones_and_writes_nothing),
		config_test(a_message_goes_where_the_host_said),
		config_test(the_pin_is_for_hosts_that_take_no_messages),
		config_test(a_reset_turns_everything_off),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
