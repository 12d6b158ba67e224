# SPDX-License-Identifier: MIT
# The library, shared and static. Lists of objects come from model.mk and draw.mk.

ACCEL_SOURCES := $(addprefix libaccel/, device.c buffer.c target.c state.c stream.c fence.c \
	transport_model.c transport_sim.c engine.c range.c option.c) $(DRAW_SOURCES)
ACCEL_OBJS := $(ACCEL_SOURCES:%.c=$(BUILD)/%.o) $(MODEL_OBJS)
ACCEL_LIBS := -lm -ldl -pthread
ACCEL_VERSION := 0.1
ACCEL_SONAME := libaccel.so.0

$(BUILD)/libaccel/%.o: libaccel/%.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -fPIC -pthread -MMD -MP -c $< -o $@

# Where the library looks for plugins once it is installed; rebuilt when that changes.
ACCEL_SIM_DIR := $(LIBDIR)/gloss
LINT_C += -DACCEL_SIM_DIR='"$(ACCEL_SIM_DIR)"'
$(BUILD)/libaccel/sim_dir: FORCE
	@mkdir -p $(@D)
	@echo '$(ACCEL_SIM_DIR)' | cmp -s - $@ || echo '$(ACCEL_SIM_DIR)' >$@
$(BUILD)/libaccel/transport_sim.o: $(BUILD)/libaccel/sim_dir
$(BUILD)/libaccel/transport_sim.o: ACCEL_CFLAGS += -DACCEL_SIM_DIR='"$(ACCEL_SIM_DIR)"'

.PHONY: FORCE
FORCE:

$(BUILD)/libaccel.so: $(ACCEL_OBJS) libaccel/libaccel.map
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -shared -Wl,-soname,$(ACCEL_SONAME) \
		-Wl,--version-script=libaccel/libaccel.map -Wl,-z,defs \
		$(ACCEL_OBJS) $(ACCEL_LIBS) -o $(BUILD)/$(ACCEL_SONAME)
	$(Q)ln -sf $(ACCEL_SONAME) $@

# One object, in which every name that is not exported has become local to it.
$(BUILD)/libaccel.a: $(ACCEL_OBJS) libaccel/libaccel.map
	$(call quiet,AR,$@)
	$(Q)sed -n 's/^\t\(accel_[a-z_]*\);$$/\1/p' libaccel/libaccel.map >$(BUILD)/libaccel/exported
	$(Q)$(LD) -r $(ACCEL_OBJS) -o $(BUILD)/libaccel/libaccel.o
	$(Q)objcopy --keep-global-symbols=$(BUILD)/libaccel/exported $(BUILD)/libaccel/libaccel.o
	$(Q)rm -f $@
	$(Q)$(AR) rcs $@ $(BUILD)/libaccel/libaccel.o

# With all names, for tests of the library's insides.
$(BUILD)/libaccel/parts.a: $(ACCEL_OBJS)
	$(call quiet,AR,$@)
	$(Q)rm -f $@
	$(Q)$(AR) qcs $@ $^

-include $(ACCEL_OBJS:.o=.d)

.PHONY: lib
lib: $(BUILD)/libaccel.so $(BUILD)/libaccel.a ## build the library alone, which takes only a C compiler

ALL += lib

# The Verilated core as plugins of "sim:", by tile size and lanes; each has the stream port
# that its lanes need. SIM_CORES are those that `make all` builds and `make install` installs.
SIM_CORES ?= t64-k8
SIM_CORES_ALL := t64-k1 t64-k2 t64-k4 t64-k8 t32-k1 t32-k2 t32-k4 t32-k8
SIM_STREAM_BITS := 1:32 2:64 4:64 8:128
SIM_DIR ?= $(BUILD)/sim

sim_tile = $(patsubst t%,%,$(firstword $(subst -k, ,$(1))))
sim_lanes = $(lastword $(subst -k, ,$(1)))
sim_stream = $(patsubst $(sim_lanes):%,%,$(filter $(sim_lanes):%,$(SIM_STREAM_BITS)))

SIM_WRAPPER := $(addprefix libaccel/, sim_wrapper.cpp sim_memory.h sim_port.h sim.h sim.map job.h \
	gloss_packets.h)
SIM_CXXFLAGS = -std=c++17 -fPIC -I$(abspath libaccel) \
	-DSIM_TILE=$(call sim_tile,$*) -DSIM_LANES=$(call sim_lanes,$*) \
	-DSIM_STREAM_BITS=$(call sim_stream,$*)

# $(1): the core's sources; the target ends in the core's name.
define sim_plugin
	$(call quiet,SIM,$@)
	@mkdir -p $(@D)/$*
	$(Q)verilator --cc --exe --build -sv -O3 --x-assign fast --x-initial fast --noassert \
		-Wno-lint -Wno-style -Irtl --top-module gloss_core --prefix Vgloss_core \
		-GTileSize=$(call sim_tile,$*) -GPixelsPerClock=$(call sim_lanes,$*) \
		-GStreamBits=$(call sim_stream,$*) --Mdir $(@D)/$* \
		-MAKEFLAGS 'OPT_FAST="$(CXXFLAGS)"' -CFLAGS '$(SIM_CXXFLAGS)' \
		-LDFLAGS '-shared -Wl,--version-script=$(abspath libaccel/sim.map)' \
		$(1) $(abspath libaccel/sim_wrapper.cpp) -o $(abspath $@) \
		>$(@D)/$*/log 2>&1 || { cat $(@D)/$*/log; exit 1; }
endef

$(BUILD)/sim/accel-sim-%.so: $(SIM_WRAPPER) $(RTL_SOURCES) rtl/gloss_hw.svh
	$(call sim_plugin,$(RTL_SOURCES))

.PHONY: sim
sim: $(SIM_CORES_ALL:%=$(BUILD)/sim/accel-sim-%.so) ## build the simulator plugins of all cores

ACCEL_SIMS := $(SIM_CORES:%=$(BUILD)/sim/accel-sim-%.so)
ALL += $(ACCEL_SIMS)

# The directories are written into the file that pkg-config reads.
.PHONY: install-lib
install-lib: lib $(ACCEL_SIMS)
	$(call quiet,INSTALL,libaccel)
	$(Q)install -d $(DESTDIR)$(PREFIX)/include/gloss $(DESTDIR)$(LIBDIR)/pkgconfig \
		$(DESTDIR)$(LIBDIR)/gloss
	$(Q)install -m 644 libaccel/accel.h libaccel/gloss_packets.h $(DESTDIR)$(PREFIX)/include/gloss
	$(Q)install -m 755 $(BUILD)/$(ACCEL_SONAME) $(DESTDIR)$(LIBDIR)
	$(Q)ln -sf $(ACCEL_SONAME) $(DESTDIR)$(LIBDIR)/libaccel.so
	$(Q)install -m 644 $(BUILD)/libaccel.a $(DESTDIR)$(LIBDIR)
	$(Q)sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@LIBDIR@|$(LIBDIR)|' -e 's|@VERSION@|$(ACCEL_VERSION)|' \
		libaccel/libaccel.pc.in >$(DESTDIR)$(LIBDIR)/pkgconfig/libaccel.pc
	$(Q)$(if $(ACCEL_SIMS),install -m 755 $(ACCEL_SIMS) $(DESTDIR)$(LIBDIR)/gloss)
INSTALLS += install-lib

# Unit tests in C: tests/unit/test_<file>.c may use, or include, any part of the library.
$(BUILD)/tests/unit/test_%: tests/unit/test_%.c $(BUILD)/libaccel/parts.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -pthread -MMD -MP -MF $@.d $< $(BUILD)/libaccel/parts.a \
		$(UNIT_LDFLAGS) -lcmocka $(ACCEL_LIBS) -o $@

run-test_%: $(BUILD)/tests/unit/test_%
	$(call quiet,TEST,$*)
	$(Q)GLOSS_SIM_PATH=$(SIM_DIR) FAKE_SIM_PATH=$(FAKE_SIM_DIR) $<

-include $(wildcard $(BUILD)/tests/unit/*.d)

ACCEL_UNIT_TESTS := test_range test_option test_engine test_device test_buffer test_target \
	test_state test_stream test_fence test_out_of_memory \
	test_transport_sim test_transport_sim_core
UNIT_TESTS += $(ACCEL_UNIT_TESTS) test_symbols

comma := ,
$(BUILD)/tests/unit/test_out_of_memory: UNIT_LDFLAGS := $(addprefix -Wl$(comma)--wrap=, \
	malloc calloc realloc free mmap munmap pthread_create pthread_join)

# Plugins without a core: one that is right, and some that are wrong in one thing each.
FAKE_SIM_DIR := $(BUILD)/tests/unit/fake-sim
FAKE_SIMS := t64-k1 t64-k2 t64-k4 t64-k8 t32-k2 t32-k4
fake_flags_t64-k2 := -DFAKE_LANES=2 -DFAKE_ABI=GLOSS_SIM_ABI+1
fake_flags_t64-k4 := -DFAKE_LANES=4 -DFAKE_VERSION=GLOSS_VERSION+1
fake_flags_t32-k2 := -UFAKE_SYMBOL -DFAKE_SYMBOL=gloss_simulator
fake_flags_t32-k4 := -c
$(FAKE_SIM_DIR)/accel-sim-%.so: tests/unit/fake_sim.c libaccel/sim.h
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -fPIC -shared -DFAKE_SYMBOL=gloss_sim $(fake_flags_$*) $< -o $@
run-test_transport_sim: $(FAKE_SIMS:%=$(FAKE_SIM_DIR)/accel-sim-%.so)

ACCEL_TEST_SIMS := $(SIM_DIR)/accel-sim-t64-k8.so $(SIM_DIR)/accel-sim-t32-k1.so
run-test_transport_sim_core run-test_out_of_memory: $(ACCEL_TEST_SIMS)

# A core that breaks the rules of its ports, for the test of the wrapper that watches them.
BAD_CORE := $(BUILD)/tests/unit/bad-core/accel-sim-t32-k1.so
$(BUILD)/tests/unit/bad-core/accel-sim-%.so: tests/unit/bad_core.sv $(SIM_WRAPPER)
	$(call sim_plugin,tests/unit/bad_core.sv)
run-test_sim_wrapper: export BAD_CORE := $(BAD_CORE)
run-test_sim_wrapper: $(BAD_CORE)
UNIT_TESTS += test_sim_wrapper

# The same tests with the compiler's checks built in, on the plugins of this build.
SANITIZE_MAKE = $(MAKE) --no-print-directory SIM_DIR=$(SIM_DIR) $(ACCEL_UNIT_TESTS:%=run-%)

.PHONY: unit-sanitize-accel unit-thread-accel unit-valgrind-accel
unit-sanitize-accel: $(ACCEL_TEST_SIMS) ## unit tests of the library under ASan and UBSan
	$(Q)+$(SANITIZE_MAKE) BUILD=$(BUILD)/asan \
		CFLAGS="-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all"

unit-thread-accel: $(ACCEL_TEST_SIMS) ## unit tests of the library under TSan
	$(Q)+TSAN_OPTIONS=halt_on_error=1 $(SANITIZE_MAKE) BUILD=$(BUILD)/tsan \
		CFLAGS="-O1 -g -fsanitize=thread"

VALGRIND_TESTS := test_engine test_device test_stream test_fence test_state test_transport_sim
unit-valgrind-accel: $(VALGRIND_TESTS:%=$(BUILD)/tests/unit/%) $(FAKE_SIMS:%=$(FAKE_SIM_DIR)/accel-sim-%.so)
	$(Q)for test in $(VALGRIND_TESTS); do \
		FAKE_SIM_PATH=$(FAKE_SIM_DIR) valgrind -q --error-exitcode=1 --leak-check=full \
			$(BUILD)/tests/unit/$$test || exit 1; \
	done

.PHONY: test-install test-readme
test-install: lib $(ACCEL_SIMS) ## install the library to a directory, and use it from there
	$(Q)rm -rf $(BUILD)/tests/install/root
	$(Q)+$(MAKE) --no-print-directory install-lib DESTDIR=$(BUILD)/tests/install/root
	$(Q)tests/install/test_install.sh $(BUILD)/tests/install/root $(PREFIX) $(LIBDIR) "$(SIM_CORES)"

test-readme: ## the README's program is the example
	$(Q)tests/install/test_readme.sh $(BUILD)/tests/install

CHECKS += test-install test-readme unit-sanitize-accel unit-thread-accel unit-valgrind-accel

.PHONY: run-test_symbols
run-test_symbols: $(BUILD)/libaccel.so $(BUILD)/libaccel.a
	$(call quiet,TEST,symbols)
	$(Q)tests/unit/test_symbols.sh $(BUILD)
