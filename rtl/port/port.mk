# SPDX-License-Identifier: MIT
# The ports and the boards of port and core: boards as plugins of vboard-pci and vboard-usb, and benches.
# BOARD_CORES are the boards that `make all` builds.
BOARD_CORES ?= t64-k8

PORT_SOURCES = $(sort $(wildcard rtl/port/*.sv))
BOARD_SOURCES = $(RTL_SOURCES) $(PORT_SOURCES) $(sort $(wildcard rtl/board/*.sv))

BOARD_SIM := $(addprefix tools/vboard/,board_sim.h board.map) \
	libaccel/sim_memory.h libaccel/sim_port.h driver/gloss_regs.h
BOARD_CXXFLAGS = -std=c++17 -fPIC -I$(abspath libaccel) -I$(abspath driver) \
	-DBOARD_TILE=$(call sim_tile,$*) -DBOARD_LANES=$(call sim_lanes,$*) \
	-DBOARD_STREAM_BITS=$(call sim_stream,$*)

# $(1): top module, $(2): its plugin's source
define board_plugin
	$(call quiet,SIM,$@)
	@mkdir -p $(@D)/$(1)-$*
	$(Q)verilator --cc --exe --build -sv -O3 --x-assign fast --x-initial fast --noassert \
		-Wno-lint -Wno-style -Irtl --top-module $(1) --prefix V$(1) \
		-GTileSize=$(call sim_tile,$*) -GPixelsPerClock=$(call sim_lanes,$*) \
		-GStreamBits=$(call sim_stream,$*) --Mdir $(@D)/$(1)-$* \
		-MAKEFLAGS 'OPT_FAST="$(CXXFLAGS)"' -CFLAGS '$(BOARD_CXXFLAGS)' \
		-LDFLAGS '-shared -Wl,--version-script=$(abspath tools/vboard/board.map)' \
		$(BOARD_SOURCES) $(abspath tools/vboard/$(2)) -o $(abspath $@) \
		>$(@D)/$(1)-$*/log 2>&1 || { cat $(@D)/$(1)-$*/log; exit 1; }
endef

$(BUILD)/sim/accel-board-%.so: $(BOARD_SIM) $(BOARD_SOURCES) rtl/gloss_hw.svh \
		$(addprefix tools/vboard/,board_rtl.cpp board_host.h board.h)
	$(call board_plugin,board_pci,board_rtl.cpp)

$(BUILD)/sim/accel-usb-%.so: $(BOARD_SIM) $(BOARD_SOURCES) rtl/gloss_hw.svh \
		$(addprefix tools/vboard/,board_usb_rtl.cpp board_usb.h)
	$(call board_plugin,board_usb,board_usb_rtl.cpp)

BOARD_RTL_PLUGIN := $(BOARD_CORES:%=$(BUILD)/sim/accel-board-%.so)
USB_RTL_PLUGIN := $(BOARD_CORES:%=$(BUILD)/sim/accel-usb-%.so)
ALL += $(BOARD_RTL_PLUGIN) $(USB_RTL_PLUGIN)

# The port alone, at each width of its own; port_gate alone.
PORT_CORES := 32-1-32 64-4-64 64-8-128
PORT_TB := $(addprefix tests/rtl/,tb_port_pci.cpp port_bench.h port_host.h \
	port_access.h port_core.h tb.h)
PORT_TB_SOURCES = rtl/gloss_pkg.sv $(PORT_SOURCES) $(addprefix rtl/lib/, \
	ram_1r1w.sv ram_fifo.sv stream_fifo.sv stream_register.sv)

PORT_TB_NEEDS := $(PORT_TB) driver/gloss_regs.h libaccel/gloss_packets.h

# $(1): parameters, $(2): sources, $(3): flags for Verilator
define port_bench
	$(call quiet,RTL,$@)
	$(Q)mkdir -p $(@D)
	$(Q)verilator --cc --exe --build -O3 --x-assign unique --x-initial unique --top-module port_pci \
		$(3) --Mdir $(@D) -o bench -MAKEFLAGS "OPT_FAST=-O2 OPT_SLOW=-O0" \
		-CFLAGS "$(call raster_define,$(1)) -I$(CURDIR)/driver -I$(CURDIR)/libaccel" \
		$(2) $(CURDIR)/tests/rtl/tb_port_pci.cpp >$(@D)/log || { cat $(@D)/log; exit 1; }
endef

$(BUILD)/rtl/port-%/bench: $(PORT_TB_NEEDS) $(PORT_TB_SOURCES) rtl/gloss_hw.svh
	$(call port_bench,$(call raster_core,$*),$(PORT_TB_SOURCES),-Irtl $(call \
		raster_set,$(call raster_core,$*)))

# The same bench on what yosys reads.
$(BUILD)/rtl/read-port-%/port_pci.v: $(PORT_TB_SOURCES) rtl/gloss_hw.svh
	$(call quiet,YOSYS,$@)
	$(Q)mkdir -p $(@D)
	$(Q)yosys -q -p "read_verilog -sv -Irtl $(PORT_TB_SOURCES); \
		chparam $(subst -G,-set ,$(subst =, ,$(call raster_set,$(call raster_core,$*)))) port_pci; \
		hierarchy -check -top port_pci; proc; flatten; opt; rename -top port_pci; \
		write_verilog -noattr $@" >$(@D)/yosys.log 2>&1 || { cat $(@D)/yosys.log; exit 1; }

$(BUILD)/rtl/read-port-%/bench: $(BUILD)/rtl/read-port-%/port_pci.v $(PORT_TB_NEEDS)
	$(call port_bench,$(call raster_core,$*),$<,-Wno-fatal -Wno-lint -Wno-style -Wno-UNOPTFLAT)

PORT_BENCHES = $(PORT_CORES:%=$(BUILD)/rtl/port-%/bench) $(BUILD)/rtl/read-port-64-4-64/bench \
	$(addprefix $(BUILD)/rtl/,gate-1/bench gate-8/bench)

GATE_SOURCES := rtl/port/port_gate.sv rtl/lib/stream_fifo.sv rtl/lib/stream_register.sv
$(BUILD)/rtl/gate-%/bench: tests/rtl/tb_port_gate.cpp tests/rtl/memory_axi.h tests/rtl/tb.h $(GATE_SOURCES)
	$(call quiet,RTL,$@)
	$(Q)mkdir -p $(@D)
	$(Q)verilator --cc --exe --build -O3 --x-assign unique --x-initial unique --top-module port_gate \
		-GDataBits=$$((32 * $*)) --Mdir $(@D) -o bench \
		-MAKEFLAGS "OPT_FAST=-O2 OPT_SLOW=-O0" -CFLAGS "-DLANES=$*" \
		$(GATE_SOURCES) $(CURDIR)/tests/rtl/tb_port_gate.cpp >$(@D)/log || { cat $(@D)/log; exit 1; }

.PHONY: rtl-port
rtl-port: $(PORT_BENCHES) ## the PCI port: jobs, interrupts, refused DMA, resets, with random stalls
	$(Q)for bench in $^; do $$bench || exit 1; done

CHECKS += rtl-port
