// SPDX-License-Identifier: MIT
/*
 * Loaded before QEMU: a KVM whose every call fails. x-pci-proxy-dev asks KVM to forward the
 * board's interrupt without looking whether there is one, and since QEMU 9 what it calls does not
 * look either but follows kvm_state, which is NULL under TCG. Where KVM runs it sets its own.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <string.h>

/* More than a KVMState of any version. Its descriptor is -1, so ioctl() answers EBADF. */
static unsigned char none[1 << 16];

static __attribute__((constructor)) void no_kvm_init(void)
{
	void **kvm_state = dlsym(RTLD_DEFAULT, "kvm_state");

	memset(none, 0xff, sizeof(none));
	/* Other programs do not have it. */
	if (kvm_state)
		*kvm_state = none;
}
