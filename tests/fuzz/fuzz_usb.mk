# SPDX-License-Identifier: MIT
# Hostile boards on USB: the whole of "usb:" on the libusb of tests/usb, and its parser alone.
##@ Fuzzing

ifneq ($(USB_LIBS),)
FUZZ_USB_INSIDE := tests/fuzz/fuzz_usb.c tests/fuzz/fuzz_usb_board.c $(USB_SOURCES) \
	$(addprefix libaccel/transport/,transport.c job_table.c pool.c range.c thread.c)
FUZZ_USB_WORLD := $(FAKE_USB_OBJS) $(MODEL_OBJS)
FUZZ_USB_PROGRAMS := $(addprefix $(BUILD)/fuzz/, \
	fuzz_usb fuzz_usb_corpus fuzz_usb_message fuzz_usb_message_corpus)

$(BUILD)/fuzz/fuzz_usb: private LIBS := -pthread
$(BUILD)/fuzz/fuzz_usb: private WRAPS := $(call wrap,$(FAKE_USB_WRAPPED))
$(BUILD)/fuzz/fuzz_usb: $(FUZZ_USB_INSIDE:%.c=$(BUILD)/fuzz/inside/%.o) \
		$(FUZZ_USB_WORLD:$(BUILD)/%=$(BUILD)/fuzz/world/%)
	$(call fuzz_link,inside)

$(BUILD)/fuzz/fuzz_usb_message: $(addprefix $(BUILD)/fuzz/inside/, tests/fuzz/fuzz_usb_message.o \
		libaccel/transport/usb/message.o)
	$(call fuzz_link,inside)

$(BUILD)/fuzz/fuzz_usb%corpus: $(BUILD)/tests/fuzz/fuzz_usb%corpus.o
	$(link)

.PHONY: fuzz-usb fuzz-usb-short
fuzz-usb: $(FUZZ_USB_PROGRAMS) ## hostile boards on USB, FUZZ_SECONDS=60 of them
	$(call fuzz_run,fuzz_usb,-max_total_time=$(FUZZ_SECONDS),$(BUILD)/fuzz/usb,fuzz_usb_corpus)

fuzz-usb-short: $(FUZZ_USB_PROGRAMS)
	$(Q)rm -rf $(BUILD)/fuzz/usb-short $(BUILD)/fuzz/usb-message
	$(call fuzz_run,fuzz_usb_message,-runs=300000 -max_total_time=10,$(BUILD)/fuzz/usb-message,fuzz_usb_message_corpus)
	$(call fuzz_run,fuzz_usb,-max_total_time=20,$(BUILD)/fuzz/usb-short,fuzz_usb_corpus)

CHECKS += fuzz-usb-short
endif
