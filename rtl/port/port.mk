# SPDX-License-Identifier: MIT
# The PCI port and the board of port and core: the board as a plugin of vboard-pci, and benches.
# BOARD_CORES are the boards that `make all` builds.
BOARD_CORES ?= t64-k8

PORT_SOURCES = $(sort $(wildcard rtl/port/*.sv))
BOARD_SOURCES = $(RTL_SOURCES) $(PORT_SOURCES) rtl/board/board_pci.sv

BOARD_WRAPPER := $(addprefix tools/vboard/,board_rtl.cpp board_host.h board.h board.map) \
	libaccel/sim_memory.h libaccel/sim_port.h driver/gloss_regs.h
BOARD_CXXFLAGS = -std=c++17 -fPIC -I$(abspath libaccel) -I$(abspath driver) \
	-DBOARD_TILE=$(call sim_tile,$*) -DBOARD_LANES=$(call sim_lanes,$*) \
	-DBOARD_STREAM_BITS=$(call sim_stream,$*)

$(BUILD)/sim/accel-board-%.so: $(BOARD_WRAPPER) $(BOARD_SOURCES) rtl/gloss_hw.svh
	$(call quiet,SIM,$@)
	@mkdir -p $(@D)/board-$*
	$(Q)verilator --cc --exe --build -sv -O3 --x-assign fast --x-initial fast --noassert \
		-Wno-lint -Wno-style -Irtl --top-module board_pci --prefix Vboard_pci \
		-GTileSize=$(call sim_tile,$*) -GPixelsPerClock=$(call sim_lanes,$*) \
		-GStreamBits=$(call sim_stream,$*) --Mdir $(@D)/board-$* \
		-MAKEFLAGS 'OPT_FAST="$(CXXFLAGS)"' -CFLAGS '$(BOARD_CXXFLAGS)' \
		-LDFLAGS '-shared -Wl,--version-script=$(abspath tools/vboard/board.map)' \
		$(BOARD_SOURCES) $(abspath tools/vboard/board_rtl.cpp) -o $(abspath $@) \
		>$(@D)/board-$*/log 2>&1 || { cat $(@D)/board-$*/log; exit 1; }

BOARD_RTL_PLUGIN := $(BOARD_CORES:%=$(BUILD)/sim/accel-board-%.so)
ALL += $(BOARD_RTL_PLUGIN)
