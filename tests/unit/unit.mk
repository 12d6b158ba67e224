# SPDX-License-Identifier: MIT
# Unit tests in C: test_<file>.c may use, or include, any part of the library.
UNIT_SOURCES := $(wildcard tests/unit/test_*.c tests/unit/*/test_*.c tests/usb/test_*.c)

$(BUILD)/tests/unit/%: tests/unit/%.c $(BUILD)/libaccel/parts.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Itests/unit $(CFLAGS) -pthread -MMD -MP -MF $@.d $< $(BUILD)/libaccel/parts.a \
		$(UNIT_LDFLAGS) -lcmocka $(ACCEL_LIBS) -o $@

define unit_run
run-$(basename $(notdir $(1))): $(BUILD)/$(basename $(1))
	$$(call quiet,TEST,$$(@:run-test_%=%))
	$(Q)GLOSS_SIM_PATH=$$(SIM_DIR) FAKE_SIM_PATH=$$(FAKE_SIM_DIR) $$<
endef
$(foreach source,$(UNIT_SOURCES),$(eval $(call unit_run,$(source))))

# And each error of accel.h has a row in its table.
run-test_errors: run-errors-table
.PHONY: run-errors-table
run-errors-table:
	$(Q)tests/unit/object/test_errors.sh $(BUILD)

-include $(wildcard $(BUILD)/tests/unit/*.d $(BUILD)/tests/unit/*/*.d $(BUILD)/tests/usb/test_*.d)

ACCEL_UNIT_TESTS := test_range test_option test_job_table test_pool test_engine test_device test_buffer \
	test_sized test_target test_state test_stream test_dump test_fence test_out_of_memory test_unload \
	test_transport_sim test_transport_sim_core
UNIT_TESTS += $(ACCEL_UNIT_TESTS) test_symbols

$(call unit,test_unload): ACCEL_CFLAGS += -DACCEL_SO='"$(BUILD)/libaccel.so"'
$(call unit,test_unload): | $(BUILD)/libaccel.so
run-test_unload: $(BUILD)/libaccel.so

comma := ,
OUT_OF_MEMORY_LDFLAGS := $(addprefix -Wl$(comma)--wrap=, \
	malloc calloc realloc free mmap munmap pthread_create pthread_join)
$(call unit,test_out_of_memory): UNIT_LDFLAGS := $(OUT_OF_MEMORY_LDFLAGS)

# A kernel with the gloss module, for tests of "drm:"; without libdrm there is nothing to test.
ifneq ($(DRM_LIBS),)
DRM_TESTS := test_transport_drm test_transport_drm_open test_transport_drm_out_of_memory
FAKE_GLOSS_OBJS := $(addprefix $(BUILD)/tests/unit/transport/,fake_gloss.o fake_gloss_job.o fake_gloss_node.o)
$(FAKE_GLOSS_OBJS): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(DRM_CFLAGS) $(CFLAGS) -pthread -MMD -MP -MF $@.d -c $< -o $@
FAKE_GLOSS_LDFLAGS := $(FAKE_GLOSS_OBJS) $(addprefix -Wl$(comma)--wrap=, \
	open close stat access readlink drmGetDevices2 drmFreeDevices)
$(call unit,$(DRM_TESTS)): $(FAKE_GLOSS_OBJS)
$(call unit,$(DRM_TESTS)): ACCEL_CFLAGS += $(DRM_CFLAGS)
$(call unit,$(DRM_TESTS)): UNIT_LDFLAGS := $(FAKE_GLOSS_LDFLAGS)
$(call unit,test_transport_drm_out_of_memory): UNIT_LDFLAGS += $(OUT_OF_MEMORY_LDFLAGS)
ACCEL_UNIT_TESTS += $(DRM_TESTS)
UNIT_TESTS += $(DRM_TESTS)
endif

# Boards on USB, on the libusb of tests/usb, whose fragment builds most of these.
ifneq ($(USB_LIBS),)
USB_UNIT_TESTS := test_transport_usb test_transport_usb_open test_transport_usb_recovery \
	test_transport_usb_wait test_transport_usb_kernel test_transport_usb_clocks \
	test_transport_usb_out_of_memory test_process test_errors
$(call unit,test_transport_usb_out_of_memory): UNIT_LDFLAGS := $(OUT_OF_MEMORY_LDFLAGS)
ACCEL_UNIT_TESTS += test_usb_message test_usb_zero $(USB_UNIT_TESTS)
UNIT_TESTS += test_usb_message test_usb_zero $(USB_UNIT_TESTS)
endif

# Plugins without a core: one that is right, and some that are wrong in one thing each.
FAKE_SIM_DIR := $(BUILD)/tests/unit/fake-sim
FAKE_SIMS := $(addsuffix .so,$(addprefix $(FAKE_SIM_DIR)/accel-sim-, \
	t64-k1 t64-k2 t64-k4 t64-k8 t32-k2 t32-k4))
fake_flags_t64-k2 := -DFAKE_LANES=2 -DFAKE_ABI=GLOSS_SIM_ABI+1
fake_flags_t64-k4 := -DFAKE_LANES=4 -DFAKE_VERSION=GLOSS_VERSION+1
fake_flags_t32-k2 := -UFAKE_SYMBOL -DFAKE_SYMBOL=gloss_simulator
fake_flags_t32-k4 := -c
$(FAKE_SIM_DIR)/accel-sim-%.so: tests/unit/transport/fake_sim.c libaccel/sim/sim.h
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -fPIC -shared -DFAKE_SYMBOL=gloss_sim $(fake_flags_$*) $< -o $@
run-test_transport_sim: $(FAKE_SIMS)

ACCEL_TEST_SIMS := $(SIM_DIR)/accel-sim-t64-k8.so $(SIM_DIR)/accel-sim-t32-k1.so
run-test_transport_sim_core run-test_out_of_memory: $(ACCEL_TEST_SIMS)

# A core that breaks the rules of its ports, for the test of the wrapper that watches them.
BAD_CORE := $(BUILD)/tests/unit/bad-core/accel-sim-t32-k1.so
$(BUILD)/tests/unit/bad-core/accel-sim-%.so: tests/unit/transport/bad_core.sv $(SIM_WRAPPER)
	$(call sim_plugin,tests/unit/transport/bad_core.sv)
run-test_sim_wrapper: export BAD_CORE := $(BAD_CORE)
run-test_sim_wrapper: $(BAD_CORE)
UNIT_TESTS += test_sim_wrapper

# The same tests with the compiler's checks built in, on the simulators of this build.
SANITIZED_TESTS = $(MODEL_TESTS) $(DRAW_UNIT_TESTS) $(ACCEL_UNIT_TESTS)
SANITIZED_CFLAGS := -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined,float-cast-overflow \
	-fno-sanitize-recover=all
SANITIZED_MAKE = $(MAKE) --no-print-directory SIM_DIR=$(SIM_DIR)

.PHONY: unit-sanitize unit-thread unit-valgrind
unit-sanitize: $(ACCEL_TEST_SIMS) ## unit tests of library and model under ASan and UBSan
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/asan CFLAGS='$(SANITIZED_CFLAGS)' \
		$(SANITIZED_TESTS:%=run-%)

unit-thread: $(ACCEL_TEST_SIMS) ## unit tests of the library under TSan
	$(Q)+TSAN_OPTIONS=halt_on_error=1 $(SANITIZED_MAKE) BUILD=$(BUILD)/tsan \
		CFLAGS='-O1 -g -fsanitize=thread' $(ACCEL_UNIT_TESTS:%=run-%)

VALGRIND_TESTS := test_engine test_device test_stream test_fence test_state test_transport_sim \
	$(filter-out %_out_of_memory,$(DRM_TESTS) $(USB_UNIT_TESTS))
unit-valgrind: $(call unit,$(VALGRIND_TESTS)) $(FAKE_SIMS)
	$(Q)for test in $(call unit,$(VALGRIND_TESTS)); do \
		FAKE_SIM_PATH=$(FAKE_SIM_DIR) valgrind -q --error-exitcode=1 --leak-check=full \
			$$test || exit 1; \
	done

.PHONY: test-install test-readme
test-install: lib $(ACCEL_SIMS) ## install the library to a directory, and use it from there
	$(Q)rm -rf $(BUILD)/tests/install/root
	$(Q)+$(MAKE) --no-print-directory install-lib DESTDIR=$(BUILD)/tests/install/root
	$(Q)tests/install/test_install.sh $(BUILD)/tests/install/root $(PREFIX) $(LIBDIR) \
		"$(SIM_CORES)"

test-readme: ## the README's program is the example
	$(Q)tests/install/test_readme.sh $(BUILD)/tests/install

CHECKS += test-install test-readme unit-sanitize unit-thread unit-valgrind

.PHONY: run-test_symbols
run-test_symbols: $(BUILD)/libaccel.so $(BUILD)/libaccel.a
	$(call quiet,TEST,symbols)
	$(Q)tests/unit/object/test_symbols.sh $(BUILD)
