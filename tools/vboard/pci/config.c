// SPDX-License-Identifier: MIT
#include <linux/pci_regs.h>
#include <string.h>

#include "vboard/pci/config.h"

#define CAPABILITY_MSI 0x40
#define CLASS_PROCESSING_ACCELERATOR 0x120000

static const uint32_t bar_bytes[VBOARD_BARS] = {
	[VBOARD_BAR_REGISTERS] = VBOARD_REGISTERS_BYTES,
	[VBOARD_BAR_FAULTS] = VBOARD_FAULTS_BYTES,
};

static uint32_t bytes_get(const uint8_t *from, int bytes)
{
	uint32_t value = 0;

	for (int i = 0; i < bytes; i++)
		value |= (uint32_t)from[i] << 8 * i;
	return value;
}

static void bytes_set(uint8_t *to, uint32_t value, int bytes)
{
	for (int i = 0; i < bytes; i++)
		to[i] = (uint8_t)(value >> 8 * i);
}

void vboard_config_reset(struct vboard_config *config)
{
	const struct {
		int address, bytes;
		uint32_t value, writable;
	} fields[] = {
		{ PCI_VENDOR_ID, 2, VBOARD_VENDOR, 0 },
		{ PCI_DEVICE_ID, 2, VBOARD_DEVICE, 0 },
		{ PCI_COMMAND, 2, 0,
		  PCI_COMMAND_MEMORY | PCI_COMMAND_MASTER | PCI_COMMAND_INTX_DISABLE },
		{ PCI_STATUS, 2, PCI_STATUS_CAP_LIST, 0 },
		{ PCI_CLASS_REVISION, 4, CLASS_PROCESSING_ACCELERATOR << 8, 0 },
		{ PCI_CACHE_LINE_SIZE, 1, 0, 0xff },
		{ PCI_BASE_ADDRESS_0, 4, 0, -bar_bytes[0] },
		{ PCI_BASE_ADDRESS_1, 4, 0, -bar_bytes[1] },
		{ PCI_SUBSYSTEM_VENDOR_ID, 2, VBOARD_VENDOR, 0 },
		{ PCI_SUBSYSTEM_ID, 2, VBOARD_SUBSYSTEM, 0 },
		{ PCI_CAPABILITY_LIST, 1, CAPABILITY_MSI, 0 },
		{ PCI_INTERRUPT_LINE, 1, 0, 0xff },
		{ PCI_INTERRUPT_PIN, 1, 1, 0 },
		{ CAPABILITY_MSI, 1, PCI_CAP_ID_MSI, 0 },
		{ CAPABILITY_MSI + PCI_MSI_FLAGS, 2, PCI_MSI_FLAGS_64BIT, PCI_MSI_FLAGS_ENABLE },
		{ CAPABILITY_MSI + PCI_MSI_ADDRESS_LO, 4, 0, 0xfffffffc },
		{ CAPABILITY_MSI + PCI_MSI_ADDRESS_HI, 4, 0, 0xffffffff },
		{ CAPABILITY_MSI + PCI_MSI_DATA_64, 2, 0, 0xffff },
	};

	memset(config, 0, sizeof(*config));
	for (size_t i = 0; i < sizeof(fields) / sizeof(fields[0]); i++) {
		bytes_set(config->bytes + fields[i].address, fields[i].value, fields[i].bytes);
		bytes_set(config->writable + fields[i].address, fields[i].writable,
			  fields[i].bytes);
	}
}

static bool config_allows(uint32_t address, int bytes)
{
	return (bytes == 1 || bytes == 2 || bytes == 4) && address < VBOARD_CONFIG_BYTES &&
	       (uint32_t)bytes <= VBOARD_CONFIG_BYTES - address;
}

uint32_t vboard_config_read(const struct vboard_config *config, uint32_t address, int bytes)
{
	if (!config_allows(address, bytes))
		return UINT32_MAX;
	return bytes_get(config->bytes + address, bytes);
}

void vboard_config_write(struct vboard_config *config, uint32_t address, uint32_t value, int bytes)
{
	uint32_t writable, old;

	if (!config_allows(address, bytes))
		return;
	old = bytes_get(config->bytes + address, bytes);
	writable = bytes_get(config->writable + address, bytes);
	bytes_set(config->bytes + address, (old & ~writable) | (value & writable), bytes);
}

static uint16_t config_command(const struct vboard_config *config)
{
	return (uint16_t)bytes_get(config->bytes + PCI_COMMAND, 2);
}

int vboard_config_find(const struct vboard_config *config, uint64_t address, uint32_t bytes,
		       uint32_t *offset)
{
	uint64_t base;

	if (!(config_command(config) & PCI_COMMAND_MEMORY))
		return -1;
	for (int i = 0; i < VBOARD_BARS; i++) {
		base = bytes_get(config->bytes + PCI_BASE_ADDRESS_0 + 4 * i, 4);
		if (address < base || address - base >= bar_bytes[i] ||
		    bytes > bar_bytes[i] - (address - base))
			continue;
		*offset = (uint32_t)(address - base);
		return i;
	}
	return -1;
}

bool vboard_config_bus_master(const struct vboard_config *config)
{
	return config_command(config) & PCI_COMMAND_MASTER;
}

bool vboard_config_msi(const struct vboard_config *config)
{
	return bytes_get(config->bytes + CAPABILITY_MSI + PCI_MSI_FLAGS, 2) & PCI_MSI_FLAGS_ENABLE;
}

void vboard_config_message(const struct vboard_config *config, uint64_t *address, uint16_t *data)
{
	const uint8_t *msi = config->bytes + CAPABILITY_MSI;

	*address = (uint64_t)bytes_get(msi + PCI_MSI_ADDRESS_HI, 4) << 32 |
		   bytes_get(msi + PCI_MSI_ADDRESS_LO, 4);
	*data = (uint16_t)bytes_get(msi + PCI_MSI_DATA_64, 2);
}

bool vboard_config_intx(struct vboard_config *config, bool level)
{
	uint32_t status = bytes_get(config->bytes + PCI_STATUS, 2) &
			  ~(uint32_t)PCI_STATUS_INTERRUPT;

	bytes_set(config->bytes + PCI_STATUS, status | (level ? PCI_STATUS_INTERRUPT : 0), 2);
	return !vboard_config_msi(config) && !(config_command(config) & PCI_COMMAND_INTX_DISABLE);
}
