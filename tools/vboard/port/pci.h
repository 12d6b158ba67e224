/* SPDX-License-Identifier: MIT */
/* The C model of the PCI port: ring, DMA and events as rtl/gloss.xml has them under bus pci. */
#ifndef VBOARD_PORT_PCI_H
#define VBOARD_PORT_PCI_H

#include "vboard/board/board.h"
#include "vboard/port/base.h"
#include "vboard/port/dma.h"

/* What the port is doing. */
enum port_state {
	PORT_READY, /* for the next job */
	PORT_RUNNING,
	PORT_ENDING,  /* the job has ended, its completion is to be written */
	PORT_STOPPED, /* by a DMA error */
};

struct port_pci {
	struct port_base base; /* STATUS is made when it is read */
	struct port_dma dma;
	bool level; /* of INTx, as the host knows it */
	enum port_state state;
	struct port_list stream, response; /* of the job under way */
};

/* Power on: fills all of @port. @host outlives it. */
void port_pci_init(struct port_pci *port, const struct gloss_board_host *host,
		   const struct port_engine *engine, const struct port_build *build);

/* As those of struct gloss_board_ops. */
uint32_t port_pci_read(const struct port_pci *port, uint32_t offset);
void port_pci_write(struct port_pci *port, uint32_t offset, uint32_t value);
bool port_pci_work(struct port_pci *port);
void port_pci_reset(struct port_pci *port);

#endif
