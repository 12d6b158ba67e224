# SPDX-License-Identifier: MIT
# Hostile boards on USB: the whole of "usb:" on the libusb of tests/usb, and its parser alone.

# What is to be looked into, and what makes up its world, which the fuzzer need not see.
FUZZ_USB_SOURCES := tests/fuzz/fuzz_usb.c $(USB_SOURCES:%=libaccel/%) libaccel/transport/transport.c \
	libaccel/transport/job_table.c libaccel/transport/pool.c libaccel/transport/range.c libaccel/transport/thread.c
FUZZ_USB_WORLD := $(FAKE_USB_SOURCES) $(MODEL_SOURCES) \
	$(addprefix tools/vboard/,board/engine.c board/usb_model.c port/base.c port/usb.c)
FUZZ_USB_WORLD_OBJS := $(FUZZ_USB_WORLD:%.c=$(BUILD)/fuzz/world/%.o)
FUZZ_USB_MESSAGE_SOURCES := tests/fuzz/fuzz_usb_message.c libaccel/transport/usb/message.c
FUZZ_USB_HEADERS := $(wildcard tests/fuzz/*.h tests/usb/*.h tools/vboard/*.h tools/vboard/*/*.h libaccel/*.h \
	libaccel/*/*.h libaccel/*/*/*.h)
FUZZ_USB_PROGRAMS := $(addprefix $(BUILD)/fuzz/, \
	fuzz_usb fuzz_usb_corpus fuzz_usb_message fuzz_usb_message_corpus)

$(FUZZ_USB_WORLD_OBJS): $(BUILD)/fuzz/world/%.o: %.c $(FUZZ_USB_HEADERS)
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(ACCEL_CFLAGS) $(FAKE_USB_CFLAGS) \
		$(subst -fsanitize=fuzzer$(comma),-fsanitize=,$(FUZZ_CFLAGS)) -pthread -c $< -o $@

$(BUILD)/fuzz/fuzz_usb: $(FUZZ_USB_SOURCES) $(FUZZ_USB_WORLD_OBJS) $(FUZZ_USB_HEADERS)
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(ACCEL_CFLAGS) $(FAKE_USB_CFLAGS) $(FUZZ_CFLAGS) -pthread \
		$(FUZZ_USB_SOURCES) $(FUZZ_USB_WORLD_OBJS) $(FAKE_USB_LDFLAGS) -o $@

$(BUILD)/fuzz/fuzz_usb_message: $(FUZZ_USB_MESSAGE_SOURCES) $(FUZZ_USB_HEADERS)
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(ACCEL_CFLAGS) -Idriver $(FUZZ_CFLAGS) $(FUZZ_USB_MESSAGE_SOURCES) -o $@

$(BUILD)/fuzz/fuzz_usb%corpus: tests/fuzz/fuzz_usb%corpus.c $(FUZZ_USB_HEADERS)
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver $(CFLAGS) $< -o $@

.PHONY: fuzz-usb fuzz-usb-short
fuzz-usb: $(FUZZ_USB_PROGRAMS) ## hostile boards on USB, FUZZ_SECONDS=60 of them
	$(call fuzz_run,fuzz_usb,-max_total_time=$(FUZZ_SECONDS),$(BUILD)/fuzz/usb,fuzz_usb_corpus)

fuzz-usb-short: $(FUZZ_USB_PROGRAMS)
	$(Q)rm -rf $(BUILD)/fuzz/usb-short $(BUILD)/fuzz/usb-message
	$(call fuzz_run,fuzz_usb_message,-runs=300000 -max_total_time=10,$(BUILD)/fuzz/usb-message,fuzz_usb_message_corpus)
	$(call fuzz_run,fuzz_usb,-max_total_time=20,$(BUILD)/fuzz/usb-short,fuzz_usb_corpus)

CHECKS += fuzz-usb-short
