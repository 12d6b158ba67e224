# SPDX-License-Identifier: MIT
# Unit tests in C. A test lies in a folder as what it tests, may use, or include, any part of the
# library, and has a name of its own: make run-NAME runs it.
##@ Library and tools

UNIT_SOURCES := $(wildcard tests/unit/*/test_*.c tests/usb/test_*.c)
UNIT_PROGRAMS := $(UNIT_SOURCES:%.c=$(BUILD)/%)
# The programs of tests by their names.
unit = $(foreach test,$(1),$(or $(filter %/$(test),$(UNIT_PROGRAMS)),$(error no unit test $(test))))
wrap = $(addprefix -Wl$(comma)--wrap=,$(1))

# The archive has all of the library's names, not only those it exports.
$(UNIT_PROGRAMS): $(BUILD)/libaccel/parts.a

define unit_run
run-$(notdir $(1)): $(1)
	$$(call quiet,TEST,$$(@:run-test_%=%))
	$(Q)GLOSS_SIM_PATH=$$(SIM_DIR) FAKE_SIM_PATH=$$(FAKE_SIM_DIR) $$<
endef
$(foreach program,$(UNIT_PROGRAMS),$(eval $(call unit_run,$(program))))

# ---- model/ ----

MODEL_TESTS := $(addprefix test_model_, command draw fault memory parallel random raster small triangle)
UNIT_TESTS += $(MODEL_TESTS)
$(call unit,$(MODEL_TESTS)): $(BUILD)/tests/unit/model/reference.o $(STREAM_RANDOM_OBJS)
$(call unit,test_model_fault): $(BUILD)/tests/unit/model/fault_cases.o

# ---- draw/ ----

DRAW_UNIT_TESTS := test_setup test_setup_surface test_small test_fetch test_arrays test_strokes test_polygons test_capture test_kept test_rectangles test_draw_gl test_geometry test_lighting test_shading \
	test_kernel test_group test_few test_bin test_content test_frame test_draw_colour test_draw_parts \
	test_draw_split test_draw_clip test_draw_spot test_draw_perspective test_draw_reports test_draw_out_of_memory
DRAW_SQUARE_TESTS := test_draw test_draw_frame test_draw_input
DRAW_UNIT_TESTS += $(DRAW_SQUARE_TESTS)
UNIT_TESTS += $(DRAW_UNIT_TESTS)

$(call unit,$(DRAW_SQUARE_TESTS)): $(BUILD)/tests/unit/draw/draw_square.o $(DECODE_OBJECTS)
$(call unit,$(DRAW_SQUARE_TESTS)): private WRAPS := $(call wrap,accel_engine_submit)
$(call unit,test_group test_kernel): private WRAPS := $(call wrap,accel_stream_lend)
$(call unit,test_slices): private WRAPS := $(call wrap,accel_engine_submit malloc realloc)
$(call unit,test_draw_out_of_memory): private WRAPS := $(call wrap,malloc calloc realloc free)

# ---- object/ and transport/ ----

ACCEL_UNIT_TESTS := test_range test_option test_job_table test_pool test_engine test_device test_buffer \
	test_sized test_target test_state test_stream test_dump test_fence test_out_of_memory test_unload \
	test_tile_threads test_workers test_slices test_transport_sim test_transport_sim_core
UNIT_TESTS += test_symbols test_sim_wrapper

$(call unit,test_tile_threads): $(STREAM_RANDOM_OBJS)
$(call unit,test_tile_threads test_workers): private WRAPS := $(call wrap,pthread_create)
$(call unit,test_target): private WRAPS := $(call wrap,accel_engine_submit)
FLAGS_tests/unit/object/test_unload.c = -DACCEL_SO='"$(BUILD)/libaccel.so"'
$(call unit,test_unload): | $(BUILD)/libaccel.so
run-test_unload: $(BUILD)/libaccel.so

OUT_OF_MEMORY_WRAPS := $(call wrap,malloc calloc realloc free mmap munmap pthread_create pthread_join)
$(call unit,test_out_of_memory): private WRAPS := $(OUT_OF_MEMORY_WRAPS)

# A kernel with the gloss module, for tests of "drm:"; without libdrm there is nothing to test.
ifneq ($(DRM_LIBS),)
DRM_TESTS := test_transport_drm \
	$(addprefix test_transport_drm_, open errors library out_of_memory)
ACCEL_UNIT_TESTS += $(DRM_TESTS)
FAKE_GLOSS_WRAPS := $(call wrap,open close stat access readlink drmGetDevices2 drmFreeDevices)
$(call unit,$(DRM_TESTS)): $(addprefix $(BUILD)/tests/unit/transport/,fake_gloss.o fake_gloss_job.o \
	fake_gloss_node.o fake_gloss_syncobj.o)
$(call unit,$(DRM_TESTS)): private WRAPS := $(FAKE_GLOSS_WRAPS)
$(call unit,test_transport_drm_out_of_memory): private WRAPS := $(FAKE_GLOSS_WRAPS) \
	$(OUT_OF_MEMORY_WRAPS)
endif

# Boards on USB, on the libusb of tests/usb instead of the real one; of its own tests some are slow under
# TSan and valgrind, and have a sample there. Other points each time; USB_FAULTS=1000 make
# run-test_usb_faults for more.
ifneq ($(USB_LIBS),)
USB_UNIT_TESTS := test_transport_usb $(addprefix test_transport_usb_, open open_errors list \
	recovery time memory wait kernel clocks out_of_memory) test_process test_errors test_detached
USB_TESTS := test_fake_usb test_fake_usb_faults test_usb_errors test_usb_faults
ACCEL_UNIT_TESTS += test_usb_message test_usb_message_garbled test_usb_zero $(USB_UNIT_TESTS) \
	$(USB_TESTS)

$(call unit,$(USB_TESTS) $(USB_UNIT_TESTS)): $(FAKE_USB_OBJS) $(STREAM_RANDOM_OBJS)
$(call unit,$(USB_TESTS) $(USB_UNIT_TESTS)): private LIBS := -lcmocka \
	$(filter-out $(USB_LIBS),$(ACCEL_LIBS))
$(call unit,$(USB_TESTS) $(USB_UNIT_TESTS)): private WRAPS := $(call wrap,$(FAKE_USB_WRAPPED))
$(call unit,test_transport_usb_out_of_memory): private WRAPS := $(call wrap,$(FAKE_USB_WRAPPED)) \
	$(OUT_OF_MEMORY_WRAPS)
$(call unit,test_errors): $(addprefix $(BUILD)/tests/unit/object/,errors_device.o errors_memory.o \
	errors_draw.o errors_stream.o)
$(call unit,test_usb_faults): $(addprefix $(BUILD)/tests/usb/,usb_fault.o usb_trial.o \
	usb_trial_job.o usb_trial_picture.o usb_trial_copy.o)

USB_FAULTS_SAMPLE ?= 40
run-test_usb_faults: export USB_FAULTS ?= 250
unit-thread unit-valgrind: export USB_FAULTS ?= $(USB_FAULTS_SAMPLE)
endif

UNIT_TESTS += $(ACCEL_UNIT_TESTS)

# Each error of accel.h has a row in a table.
run-test_errors: run-errors-table
.PHONY: run-errors-table run-test_symbols
run-errors-table:
	$(Q)tests/unit/object/test_errors.sh $(BUILD)

run-test_symbols: $(BUILD)/libaccel.so $(BUILD)/libaccel.a
	$(call quiet,TEST,symbols)
	$(Q)tests/unit/object/test_symbols.sh $(BUILD)

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

# ---- vboard/ ----

VBOARD_TESTS := test_vboard_config test_vboard_memory test_vboard_message test_vboard_faults \
	test_vboard_door test_vboard_door_jobs test_vboard_qtest
$(call unit,$(VBOARD_TESTS)): $(VBOARD_OBJECTS) $(BOARD_MODEL_OBJECTS)

VBOARD_USB_TESTS := test_vboard_usb test_vboard_usb_jobs test_vboard_usb_wild test_vboard_usb_bridge \
	test_vboard_usb_bridge_faults
$(call unit,$(VBOARD_USB_TESTS)): $(VBOARD_USB_OBJECTS) $(BOARD_USB_MODEL_OBJECTS)
$(call unit,$(VBOARD_USB_TESTS)): private LIBS := -lcmocka $(VBOARD_USB_LIBS) $(ACCEL_LIBS)

# Those in which a board has its thread.
VBOARD_THREAD_TESTS := test_vboard_door test_vboard_door_jobs test_vboard_qtest test_vboard_usb \
	test_vboard_usb_jobs test_vboard_usb_wild

# Tests of what is late have a clock of their own, and those of what is waited for wait for ever.
$(call unit,test_vboard_faults test_vboard_usb_bridge_faults): private WRAPS := $(call wrap,clock_gettime)
$(call unit,test_vboard_door test_vboard_door_jobs test_vboard_qtest): private WRAPS := \
	$(call wrap,pthread_cond_clockwait)

BOARD_UNIT_TESTS := test_port_pci test_port_pci_ring test_port_pci_reset test_port_usb \
	test_port_usb_sync test_port_usb_flow test_port_usb_reset test_board_model test_board_usb_model
$(call unit,$(BOARD_UNIT_TESTS)): $(PORT_TEST_OBJS) $(STREAM_RANDOM_OBJS) \
	$(sort $(BOARD_MODEL_OBJECTS) $(BOARD_USB_MODEL_OBJECTS))

UNIT_TESTS += $(VBOARD_TESTS) $(VBOARD_USB_TESTS) $(BOARD_UNIT_TESTS)

# ---- tools/ ----

DECODE_UNIT_TESTS := test_decode test_decode_print test_decode_random
$(call unit,$(DECODE_UNIT_TESTS)): $(DECODE_OBJECTS)

# ---- the same with the compiler's checks built in, on the simulators of this build ----

SANITIZED_TESTS = $(MODEL_TESTS) $(DRAW_UNIT_TESTS) $(ACCEL_UNIT_TESTS) $(BOARD_UNIT_TESTS)
THREAD_TESTS = $(ACCEL_UNIT_TESTS)
SANITIZED_CFLAGS := -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined,float-cast-overflow \
	-fno-sanitize-recover=all
SANITIZED_MAKE = $(MAKE) --no-print-directory SIM_DIR=$(SIM_DIR)

.PHONY: unit-sanitize unit-thread unit-valgrind
unit-sanitize: $(ACCEL_TEST_SIMS) ## unit tests of library, model and OpenGL under ASan and UBSan
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/asan CFLAGS='$(SANITIZED_CFLAGS)' \
		$(SANITIZED_TESTS:%=run-%)

unit-thread: $(ACCEL_TEST_SIMS) ## unit tests of the library and OpenGL under TSan
	$(Q)+TSAN_OPTIONS='halt_on_error=1 die_after_fork=0' $(SANITIZED_MAKE) BUILD=$(BUILD)/tsan \
		CFLAGS='-O1 -g -fsanitize=thread' $(THREAD_TESTS:%=run-%)

VALGRIND_TESTS := test_engine test_tile_threads test_workers test_device test_stream test_fence test_state \
	test_transport_sim $(filter-out %_out_of_memory,$(DRM_TESTS) $(USB_UNIT_TESTS)) $(filter-out %_errors,$(USB_TESTS))
unit-valgrind: $(call unit,$(VALGRIND_TESTS)) $(FAKE_SIMS)
	$(Q)for test in $(call unit,$(VALGRIND_TESTS)); do \
		FAKE_SIM_PATH=$(FAKE_SIM_DIR) valgrind -q --error-exitcode=1 --leak-check=full \
			$$test || exit 1; \
	done

CHECKS += unit-sanitize unit-thread unit-valgrind

# Which lines these tests run, as a table and as pages. Wrapped allocators would count gcov's, too.
COVERED_TESTS = $(filter-out test_symbols test_sim_wrapper %_out_of_memory,$(filter test_%,$(UNIT_TESTS))) \
	decode hwgen
.PHONY: coverage
coverage: $(ACCEL_TEST_SIMS) ## lines that the unit tests run: build/coverage/report/index.html
	$(Q)find $(BUILD)/coverage -name '*.gcda' -delete 2>/dev/null || true
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/coverage CFLAGS='-O1 -g --coverage' $(COVERED_TESTS:%=run-%)
	$(Q)mkdir -p $(BUILD)/coverage/report
	$(Q)gcovr --root . --filter libaccel/ --filter tools/ --object-directory $(BUILD)/coverage \
		--html-details $(BUILD)/coverage/report/index.html --txt --print-summary $(BUILD)/coverage
