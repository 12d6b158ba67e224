# SPDX-License-Identifier: MIT
# Benches of the command stage and of the streams in rtl/lib; figures of the core.
##@ RTL

# Words that each of rtl/lib's streams holds.
LIB_STREAMS := stream_register-2 stream_fifo-8 ram_fifo-65
LIB_DEPTH = $(if $(filter stream_fifo,$(1)),-GDepth=8) $(if $(filter ram_fifo,$(1)),-GDepth=64)

define lib_bench
$(BUILD)/rtl/lib-$(1)/bench: tests/rtl/tb_lib.cpp tests/rtl/tb.h rtl/lib/$(1).sv rtl/lib/ram_1r1w.sv
	$$(call quiet,RTL,$$@)
	$(Q)mkdir -p $$(@D)
	$(Q)$(VERILATE) -O3 --x-initial unique --top-module $(1) -GWidth=37 \
		$(call LIB_DEPTH,$(1)) -Irtl/lib --Mdir $$(@D) -o bench \
		-CFLAGS "-DTOP=$(1) -DCAPACITY=$(2) -I$$(CURDIR)/tests/rtl" \
		rtl/lib/$(1).sv $$(CURDIR)/tests/rtl/tb_lib.cpp >$$(@D)/log || \
		{ cat $$(@D)/log; exit 1; }
LIB_BENCHES += $(BUILD)/rtl/lib-$(1)/bench
endef
$(foreach stream,$(LIB_STREAMS),$(eval $(call lib_bench,$(firstword $(subst -, ,$(stream))),$(lastword $(subst -, ,$(stream))))))

.PHONY: rtl-lib
rtl-lib: $(LIB_BENCHES) ## the streams of rtl/lib, with random stalls
	$(Q)for bench in $^; do $$bench || exit 1; done

# command, at the ends of its parameters.
COMMAND_CORES := 32-1-32 64-2-64 64-8-128
COMMAND_SOURCES = rtl/gloss_pkg.sv $(wildcard rtl/command/*.sv) \
	rtl/lib/ram_1r1w.sv rtl/lib/ram_fifo.sv rtl/lib/stream_register.sv

COMMAND_TB := $(addprefix tests/rtl/,tb_command.cpp command_bench.h command_expected.h command_stream.h tb.h)
COMMAND_MODEL := $(addprefix $(BUILD)/libaccel/model/,command_check.o memory.o)

define command_bench
$(BUILD)/rtl/command-$(1)-$(2)-$(3)/bench: $(COMMAND_TB) $(COMMAND_SOURCES) rtl/gloss_hw.svh $(COMMAND_MODEL)
	$$(call quiet,RTL,$$@)
	$(Q)mkdir -p $$(@D)
	$(Q)$(VERILATE) -O3 --x-assign unique --x-initial unique --top-module command \
		-GTileSize=$(1) -GPixelsPerClock=$(2) -GStreamBits=$(3) -Irtl --Mdir $$(@D) -o bench \
		-CFLAGS "-O2 -DTILE=$(1) -DLANES=$(2) -DSTREAM=$(3) -I$$(CURDIR)/libaccel" \
		$$(COMMAND_SOURCES) $$(CURDIR)/tests/rtl/tb_command.cpp $$(COMMAND_MODEL:%=$$(CURDIR)/%) \
		>$$(@D)/log || { cat $$(@D)/log; exit 1; }
COMMAND_BENCHES += $(BUILD)/rtl/command-$(1)-$(2)-$(3)/bench
endef
$(foreach core,$(COMMAND_CORES),$(eval $(call command_bench,$(word 1,$(subst -, ,$(core))),$(word 2,$(subst -, ,$(core))),$(word 3,$(subst -, ,$(core))))))

.PHONY: rtl-command
rtl-command: $(COMMAND_BENCHES) ## command against the model's checks, with random stalls
	$(Q)for bench in $^; do $$bench || exit 1; done

CHECKS += rtl-lib rtl-command

# Figures of the core in clocks; it fails if one misses its aim.
BENCH_CORES := $(foreach lanes,1 2 4 8,$(BUILD)/sim/accel-sim-t64-k$(lanes).so)

$(BUILD)/tests/bench/bench_core: private LIBS := -ldl
$(BUILD)/tests/bench/bench_core: $(BUILD)/tests/bench/bench_core.o
	$(link)

##@ Pictures and figures
.PHONY: bench-core check-speed
bench-core: $(BUILD)/tests/bench/bench_core $(BENCH_CORES) ## pixels a clock, clocks a triangle, hidden transfers
	$(Q)$(call keep_figures,core,$< $(BENCH_CORES))

check-speed: $(BUILD)/tests/bench/bench_core $(BENCH_CORES) ## the core is as fast as it should be
	$(Q)$< $(BENCH_CORES)

BENCHES += bench-core
CHECKS += check-speed
