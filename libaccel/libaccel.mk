# SPDX-License-Identifier: MIT
# The library, shared and static. Lists of objects come from model.mk and draw.mk.

ACCEL_SOURCES := $(addprefix libaccel/, device.c buffer.c target.c state.c stream.c fence.c \
	transport_model.c engine.c range.c option.c) $(DRAW_SOURCES)
ACCEL_OBJS := $(ACCEL_SOURCES:%.c=$(BUILD)/%.o) $(MODEL_OBJS)
ACCEL_LIBS := -lm -ldl -pthread
ACCEL_SONAME := libaccel.so.0

$(BUILD)/libaccel/%.o: libaccel/%.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -fPIC -pthread -MMD -MP -c $< -o $@

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
	$(Q)$(AR) rcs $@ $^

-include $(ACCEL_OBJS:.o=.d)

.PHONY: lib
lib: $(BUILD)/libaccel.so $(BUILD)/libaccel.a ## build the library alone, which takes only a C compiler

ALL += lib

# Unit tests in C: tests/unit/test_<file>.c may use, or include, any part of the library.
$(BUILD)/tests/unit/test_%: tests/unit/test_%.c $(BUILD)/libaccel/parts.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -pthread -MMD -MP -MF $@.d $< $(BUILD)/libaccel/parts.a \
		-lcmocka $(ACCEL_LIBS) -o $@

run-test_%: $(BUILD)/tests/unit/test_%
	$(call quiet,TEST,$*)
	$(Q)$<

-include $(wildcard $(BUILD)/tests/unit/*.d)
