# SPDX-License-Identifier: MIT
# The Verilated core as plugins of "sim:", by tile size and lanes; each has the stream port
# that its lanes need, or the one in a third part of its name (t64-k8-s32). SIM_CORES are those
# that `make all` builds and `make install` installs.
##@ Building
SIM_CORES ?= t64-k8
SIM_CORES_ALL := t64-k1 t64-k2 t64-k4 t64-k8 t32-k1 t32-k2 t32-k4 t32-k8
SIM_STREAM_BITS := 1:32 2:64 4:64 8:128
SIM_DIR ?= $(BUILD)/sim

sim_tile = $(patsubst t%,%,$(word 1,$(subst -, ,$(1))))
sim_lanes = $(patsubst k%,%,$(word 2,$(subst -, ,$(1))))
sim_stream = $(or $(patsubst s%,%,$(word 3,$(subst -, ,$(1)))),$(patsubst \
	$(sim_lanes):%,%,$(filter $(sim_lanes):%,$(SIM_STREAM_BITS))))

SIM_WRAPPER := $(addprefix libaccel/sim/, sim_wrapper.cpp sim_memory.h sim_port.h sim.h sim.map) \
	libaccel/job.h libaccel/gloss_packets.h
SIM_CXXFLAGS = -std=c++17 -fPIC -I$(abspath libaccel) \
	-DSIM_TILE=$(call sim_tile,$*) -DSIM_LANES=$(call sim_lanes,$*) \
	-DSIM_STREAM_BITS=$(call sim_stream,$*)

# $(1): the core's sources; the target ends in the core's name.
define sim_plugin
	$(call quiet,SIM,$@)
	@mkdir -p $(@D)/$*
	$(Q)$(VERILATE) -sv -O3 --x-assign fast --x-initial fast \
		-Wno-lint -Wno-style -Irtl --top-module gloss_core --prefix Vgloss_core \
		-GTileSize=$(call sim_tile,$*) -GPixelsPerClock=$(call sim_lanes,$*) \
		-GStreamBits=$(call sim_stream,$*) --Mdir $(@D)/$* \
		-MAKEFLAGS 'OPT_FAST="$(CXXFLAGS)"' -CFLAGS '$(SIM_CXXFLAGS)' \
		-LDFLAGS '-shared -Wl,--version-script=$(abspath libaccel/sim/sim.map)' \
		$(1) $(abspath libaccel/sim/sim_wrapper.cpp) -o $(abspath $@) \
		>$(@D)/$*/log 2>&1 || { cat $(@D)/$*/log; exit 1; }
endef

$(BUILD)/sim/accel-sim-%.so: $(SIM_WRAPPER) $(RTL_SOURCES) rtl/gloss_hw.svh
	$(call sim_plugin,$(RTL_SOURCES))

.PHONY: sim
sim: $(SIM_CORES_ALL:%=$(BUILD)/sim/accel-sim-%.so) ## build the simulator plugins of all cores

ACCEL_SIMS := $(SIM_CORES:%=$(BUILD)/sim/accel-sim-%.so)
ALL += $(ACCEL_SIMS)
