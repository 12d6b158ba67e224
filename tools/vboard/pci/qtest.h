/* SPDX-License-Identifier: MIT */
/*
 * Interrupts through QEMU's qtest socket: x-pci-proxy-dev can raise them only under
 * KVM. An MSI is a write to its address, INTx a level at a pin of q35's I/O APIC.
 *
 * QEMU takes commands in its main loop, which a device that is asked something from
 * there keeps waiting: see vboard_qtest_level.
 */
#ifndef VBOARD_QTEST_H
#define VBOARD_QTEST_H

#include <stdbool.h>
#include <stdint.h>

struct vboard_qtest;

/*
 * Connects to the socket at @path, and again and again until QEMU listens there.
 * One connection serves all boards, from any thread. 0, or -errno.
 */
int vboard_qtest_new(const char *path, struct vboard_qtest **qtest);
void vboard_qtest_free(struct vboard_qtest *qtest);

/* Sends an MSI and does not wait for it. */
void vboard_qtest_message(struct vboard_qtest *qtest, uint64_t address, uint16_t data);

/*
 * Raises or lowers INTA of the board in @slot of q35's bus pcie.0. Boards may share
 * a pin. @wait: returns when QEMU has done it; not to be used while the main loop of
 * QEMU waits for the caller.
 */
void vboard_qtest_level(struct vboard_qtest *qtest, unsigned int slot, bool level, bool wait);

/* Slots whose pin vboard_qtest_level knows: 0 to this. */
#define VBOARD_SLOT_MAX 24

#endif
