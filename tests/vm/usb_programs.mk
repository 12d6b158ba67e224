# SPDX-License-Identifier: MIT
# The library and the programs on USB boards, as the ordinary user meets them.

VM_TESTS += user:test_usb_bunny:600 user:test_usb_programs root:test_usb_messages:600 \
	root:test_usb_rule user:test_usb_stream:600
VM_BENCHES += user:test_usb_throughput:900
VM_ONCE += test_usb_bunny test_usb_stream
VM_NEEDS += $(BUILD)/gloss-info

$(BUILD)/tests/vm/test_usb_stream: $(VM_STREAM_OBJS)

$(BUILD)/tests/vm/test_usb_throughput: $(BUILD)/tests/vm/usb_plain.o
