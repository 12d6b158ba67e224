# SPDX-License-Identifier: MIT
# Benches of the ports, and refused parameters.
##@ RTL

# Each port alone, at each width of its own, one without counters of clocks; port_gate alone.
PORT_CORES := 32-1-32 64-4-64-0 64-8-128
port_counters = $(or $(word 4,$(1)),1)
port_set = $(call raster_set,$(1)) -GTimeCounters=$(call port_counters,$(1))
port_define = $(call raster_define,$(1)) -DTIME_COUNTERS=$(call port_counters,$(1))
PORT_TB_SOURCES = rtl/gloss_pkg.sv $(PORT_SOURCES) $(addprefix rtl/lib/, \
	axi_rules.sv core_parameters.sv ram_1r1w.sv ram_fifo.sv stream_fifo.sv stream_register.sv)
PORT_TB_NEEDS := $(addprefix tests/rtl/,port_access.h port_core.h tb.h) \
	driver/gloss_regs.h libaccel/gloss_packets.h
PORT_TB_pci := $(addprefix tests/rtl/,tb_port_pci.cpp tb_port_pci_faults.cpp port_bench.h port_host.h)
PORT_TB_usb := $(addprefix tests/rtl/,tb_port_usb.cpp tb_port_usb_faults.cpp port_usb_bench.h) \
	libaccel/transport/usb/checksum.h

# $(1): port, $(2): parameters, $(3): sources, $(4): flags for Verilator
define port_bench
	$(call quiet,RTL,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(VERILATE) -O3 --x-assign unique --x-initial unique --top-module port_$(1) \
		$(4) --Mdir $(@D) -o bench -MAKEFLAGS "OPT_FAST=-O2 OPT_SLOW=-O0" \
		-CFLAGS "$(call port_define,$(2)) -I$(CURDIR)/driver -I$(CURDIR)/libaccel" \
		$(3) $(abspath $(filter %.cpp,$(PORT_TB_$(1)))) >$(@D)/log || { cat $(@D)/log; exit 1; }
endef

# The same bench on what yosys reads. $(1): port
define port_read
	$(call quiet,YOSYS,$@)
	$(Q)mkdir -p $(@D)
	$(Q)yosys -q -p "read_verilog -sv -Irtl $(PORT_TB_SOURCES); \
		chparam $(subst -G,-set ,$(subst =, ,$(call port_set,$(call raster_core,$*)))) port_$(1); \
		hierarchy -check -top port_$(1); proc; flatten; opt; rename -top port_$(1); \
		write_verilog -noattr $@" >$(@D)/yosys.log 2>&1 || { cat $(@D)/yosys.log; exit 1; }
endef

# $(1): port
define port_rules
$$(BUILD)/rtl/port-$(1)-%/bench: $$(PORT_TB_$(1)) $$(PORT_TB_NEEDS) $$(PORT_TB_SOURCES) rtl/gloss_hw.svh
	$$(call port_bench,$(1),$$(call raster_core,$$*),$$(PORT_TB_SOURCES),-Irtl $$(call \
		port_set,$$(call raster_core,$$*)))

$$(BUILD)/rtl/read-port-$(1)-%/port_$(1).v: $$(PORT_TB_SOURCES) rtl/gloss_hw.svh
	$$(call port_read,$(1))

$$(BUILD)/rtl/read-port-$(1)-%/bench: $$(BUILD)/rtl/read-port-$(1)-%/port_$(1).v $$(PORT_TB_$(1)) \
		$$(PORT_TB_NEEDS)
	$$(call port_bench,$(1),$$(call raster_core,$$*),$$<,-Wno-fatal -Wno-lint -Wno-style -Wno-UNOPTFLAT)

PORT_BENCHES_$(1) := $$(PORT_CORES:%=$$(BUILD)/rtl/port-$(1)-%/bench) \
	$$(BUILD)/rtl/read-port-$(1)-64-4-64/bench
endef
$(foreach port,pci usb,$(eval $(call port_rules,$(port))))

PORT_BENCHES := $(PORT_BENCHES_pci) $(PORT_BENCHES_usb) \
	$(addprefix $(BUILD)/rtl/,gate-1/bench gate-8/bench)

GATE_SOURCES := rtl/port/port_gate.sv rtl/lib/axi_rules.sv rtl/lib/stream_fifo.sv rtl/lib/stream_register.sv
$(BUILD)/rtl/gate-%/bench: tests/rtl/tb_port_gate.cpp tests/rtl/memory_axi.h tests/rtl/tb.h $(GATE_SOURCES)
	$(call quiet,RTL,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(VERILATE) -O3 --x-assign unique --x-initial unique --top-module port_gate \
		-GDataBits=$$((32 * $*)) --Mdir $(@D) -o bench \
		-MAKEFLAGS "OPT_FAST=-O2 OPT_SLOW=-O0" -CFLAGS "-DLANES=$*" \
		$(GATE_SOURCES) $(CURDIR)/tests/rtl/tb_port_gate.cpp >$(@D)/log || { cat $(@D)/log; exit 1; }

.PHONY: rtl-port rtl-parameters
rtl-port: $(PORT_BENCHES) ## the ports: jobs, events, what a bus may do wrong, resets, with random stalls
	$(Q)for bench in $^; do $$bench || exit 1; done

rtl-parameters: ## Verilator and yosys refuse parameters that the RTL was not made for
	$(call quiet,TEST,$@)
	$(Q)tests/rtl/parameters $(BOARD_SOURCES)

CHECKS += rtl-port rtl-parameters
