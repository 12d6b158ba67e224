// SPDX-License-Identifier: MIT
/* The module drives both boards, and says of them what they are. */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/ioctl.h>
#include <xf86drm.h>

#include "gloss_drm.h"
#include "gloss_packets.h"
#include "vm_test.h"

/* What vboard-pci makes if it is not told. */
#define MEMORY_SIZE (256u << 20)

struct expected {
	uint32_t param;
	uint64_t value;
	const char *name;
};

static void check_driver(int fd, const char *node)
{
	drmVersion *version = drmGetVersion(fd);

	if (!version || strcmp(version->name, "gloss") != 0)
		vm_fail("%s is not of the gloss module", node);
	VM_PRINT("%s: %s %d.%d.%d, %s\n", node, version->name, version->version_major,
		 version->version_minor, version->version_patchlevel, version->desc);
	drmFreeVersion(version);
}

static void check_params(int fd, const char *node, uint64_t lanes)
{
	const struct expected list[] = {
		{ DRM_GLOSS_PARAM_VERSION, GLOSS_VERSION, "version" },
		{ DRM_GLOSS_PARAM_TILE_SIZE, 64, "tile size" },
		{ DRM_GLOSS_PARAM_PIXELS_PER_CLOCK, lanes, "pixels per clock" },
		{ DRM_GLOSS_PARAM_MEMORY_SIZE, MEMORY_SIZE, "memory size" },
		{ DRM_GLOSS_PARAM_SLOTS, GLOSS_SLOTS, "slots" },
		{ DRM_GLOSS_PARAM_JOBS_LOST, 0, "jobs lost" },
	};

	for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); i++) {
		struct drm_gloss_get_param get = { .param = list[i].param };

		if (ioctl(fd, DRM_IOCTL_GLOSS_GET_PARAM, &get))
			vm_fail("%s: %s: %s", node, list[i].name, strerror(errno));
		if (get.value != list[i].value)
			vm_fail("%s: %s is %" PRIu64 ", not %" PRIu64, node, list[i].name,
				(uint64_t)get.value, list[i].value);
	}
}

static void check_board(const char *node_variable, const char *pci_variable, uint64_t lanes)
{
	const char *node = vm_env(node_variable), *pci = vm_env(pci_variable);
	int fd = open(node, O_RDWR | O_CLOEXEC);
	drmDevice *device;

	if (fd < 0)
		vm_fail("%s: %s", node, strerror(errno));
	check_driver(fd, node);
	check_params(fd, node, lanes);
	if (drmGetDevice2(fd, 0, &device))
		vm_fail("%s: libdrm does not know it", node);
	if (device->bustype != DRM_BUS_PCI || device->deviceinfo.pci->device_id != 0x474c)
		vm_fail("%s is not on a PCI board", node);
	drmFreeDevice(&device);
	VM_PRINT("%s: %s\n", node, pci);
	close(fd);
}

int main(void)
{
	check_board("GLOSS_NODE_RTL", "GLOSS_PCI_RTL", 8);
	check_board("GLOSS_NODE_MODEL", "GLOSS_PCI_MODEL", 1);
	if (!strcmp(vm_env("GLOSS_NODE_RTL"), vm_env("GLOSS_NODE_MODEL")))
		vm_fail("both boards have the same node");
	return VM_PASS;
}
