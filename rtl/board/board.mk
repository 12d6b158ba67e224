# SPDX-License-Identifier: MIT
# The boards of port and core, as plugins of vboard-pci and vboard-usb.
# BOARD_CORES are the boards that `make all` builds.
BOARD_CORES ?= t64-k8

PORT_SOURCES = $(sort $(wildcard rtl/port/*.sv))
BOARD_SOURCES = $(RTL_SOURCES) $(PORT_SOURCES) $(sort $(wildcard rtl/board/*.sv))

BOARD_SIM := $(addprefix tools/vboard/board/,sim.h board.map) \
	libaccel/sim/sim_memory.h libaccel/sim/sim_port.h driver/gloss_regs.h
BOARD_CXXFLAGS = -std=c++17 -fPIC -I$(abspath libaccel) -I$(abspath driver) -I$(abspath tools) \
	-DBOARD_TILE=$(call sim_tile,$*) -DBOARD_LANES=$(call sim_lanes,$*) \
	-DBOARD_STREAM_BITS=$(call sim_stream,$*)

# $(1): top module, $(2): its plugin's source
define board_plugin
	$(call quiet,SIM,$@)
	@mkdir -p $(@D)/$(1)-$*
	$(Q)$(VERILATE) -sv -O3 --x-assign fast --x-initial fast \
		-Wno-lint -Wno-style -Irtl --top-module $(1) --prefix V$(1) \
		-GTileSize=$(call sim_tile,$*) -GPixelsPerClock=$(call sim_lanes,$*) \
		-GStreamBits=$(call sim_stream,$*) --Mdir $(@D)/$(1)-$* \
		-MAKEFLAGS 'OPT_FAST="$(CXXFLAGS)"' -CFLAGS '$(BOARD_CXXFLAGS)' \
		-LDFLAGS '-shared -Wl,--version-script=$(abspath tools/vboard/board/board.map)' \
		$(BOARD_SOURCES) $(abspath tools/vboard/board/$(2)) -o $(abspath $@) \
		>$(@D)/$(1)-$*/log 2>&1 || { cat $(@D)/$(1)-$*/log; exit 1; }
endef

$(BUILD)/sim/accel-board-%.so: $(BOARD_SIM) $(BOARD_SOURCES) rtl/gloss_hw.svh \
		$(addprefix tools/vboard/board/,pci_rtl.cpp host.h board.h)
	$(call board_plugin,board_pci,pci_rtl.cpp)

$(BUILD)/sim/accel-usb-%.so: $(BOARD_SIM) $(BOARD_SOURCES) rtl/gloss_hw.svh \
		$(addprefix tools/vboard/board/,usb_rtl.cpp usb.h)
	$(call board_plugin,board_usb,usb_rtl.cpp)

BOARD_RTL_PLUGIN := $(BOARD_CORES:%=$(BUILD)/sim/accel-board-%.so)
USB_RTL_PLUGIN := $(BOARD_CORES:%=$(BUILD)/sim/accel-usb-%.so)
ALL += $(BOARD_RTL_PLUGIN) $(USB_RTL_PLUGIN)
