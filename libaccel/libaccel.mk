# SPDX-License-Identifier: MIT
# The library, shared and static.
##@ Building

include libaccel/model/model.mk
include libaccel/draw/draw.mk

# "drm:" takes libdrm; without it the library says so when it is asked for a PCI board.
ifeq ($(shell pkg-config --exists 'libdrm >= 2.4.99' 2>/dev/null && echo yes),yes)
DRM_SOURCES := $(addprefix libaccel/transport/drm/, drm.c job.c node.c buffer.c)
DRM_CFLAGS := -Idriver $(shell pkg-config --cflags libdrm)
DRM_LIBS := $(shell pkg-config --libs libdrm)
else
DRM_SOURCES := libaccel/transport/drm/none.c
endif

# "usb:" takes libusb, likewise.
ifeq ($(shell pkg-config --exists 'libusb-1.0 >= 1.0.21' 2>/dev/null && echo yes),yes)
USB_SOURCES := $(addprefix libaccel/transport/usb/, usb.c job_message.c memory.c link.c link_state.c \
	message.c node.c sync.c where.c transfer.c watch.c clocks.c zero.c)
USB_CFLAGS := -Idriver $(shell pkg-config --cflags libusb-1.0)
USB_LIBS := $(shell pkg-config --libs libusb-1.0)
else
USB_SOURCES := libaccel/transport/usb/none.c
endif

ACCEL_SOURCES := $(addprefix libaccel/, device.c buffer.c target.c state.c stream.c fence.c dump.c \
		message.c sized.c version.c) \
	$(addprefix libaccel/transport/, transport.c model.c tile_threads.c sim.c plugin.c engine.c job_table.c \
		pool.c range.c option.c thread.c workers.c) $(DRM_SOURCES) $(USB_SOURCES) $(DRAW_SOURCES)
ACCEL_OBJS := $(ACCEL_SOURCES:%.c=$(BUILD)/%.o) $(MODEL_OBJS)
ACCEL_LIBS := -lm -ldl -pthread $(DRM_LIBS) $(USB_LIBS)
ACCEL_VERSION := $(shell cat VERSION)
ACCEL_SONAME := libaccel.so.0

FLAGS_libaccel := -fPIC -pthread
FLAGS_libaccel/transport/drm := $(DRM_CFLAGS)
FLAGS_libaccel/transport/usb := $(USB_CFLAGS)

# Where plugins are looked for once they are installed; rebuilt when that changes.
ACCEL_SIM_DIR := $(LIBDIR)/gloss
$(BUILD)/libaccel/sim_dir: FORCE
	@mkdir -p $(@D)
	@echo '$(ACCEL_SIM_DIR)' | cmp -s - $@ || echo '$(ACCEL_SIM_DIR)' >$@
$(BUILD)/libaccel/transport/plugin.o: $(BUILD)/libaccel/sim_dir
FLAGS_libaccel/transport/plugin.c = -DACCEL_SIM_DIR='"$(ACCEL_SIM_DIR)"'

$(BUILD)/libaccel.so: $(ACCEL_OBJS) libaccel/libaccel.map
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -shared -Wl,-soname,$(ACCEL_SONAME) \
		-Wl,--version-script=libaccel/libaccel.map -Wl,-z,defs -Wl,-z,nodelete \
		$(ACCEL_OBJS) $(ACCEL_LIBS) -o $(BUILD)/$(ACCEL_SONAME)
	$(Q)ln -sf $(ACCEL_SONAME) $@

# One object, in which every name that is not exported has become local to it.
$(BUILD)/libaccel.a: $(ACCEL_OBJS) libaccel/libaccel.map
	$(call quiet,AR,$@)
	$(Q)sed -n 's/^\t\(accel_[a-z_]*\);$$/\1/p' libaccel/libaccel.map \
		>$(BUILD)/libaccel/exported
	$(Q)$(LD) -r $(ACCEL_OBJS) -o $(BUILD)/libaccel/libaccel.o
	$(Q)objcopy --keep-global-symbols=$(BUILD)/libaccel/exported $(BUILD)/libaccel/libaccel.o
	$(Q)rm -f $@
	$(Q)$(AR) rcs $@ $(BUILD)/libaccel/libaccel.o

# With all names, for tests of the library's insides.
$(BUILD)/libaccel/parts.a: $(ACCEL_OBJS)
	$(call quiet,AR,$@)
	$(Q)rm -f $@
	$(Q)$(AR) qcs $@ $^

.PHONY: lib
lib: $(BUILD)/libaccel.so $(BUILD)/libaccel.a ## build the library alone: takes only a C compiler

ALL += lib

include libaccel/sim/sim.mk

# The directories are written into the file that pkg-config reads.
.PHONY: install-lib
install-lib: lib $(ACCEL_SIMS)
	$(call quiet,INSTALL,libaccel)
	$(Q)install -d $(DESTDIR)$(PREFIX)/include/gloss $(DESTDIR)$(LIBDIR)/pkgconfig \
		$(DESTDIR)$(LIBDIR)/gloss
	$(Q)install -m 644 libaccel/accel.h libaccel/accel_draw.h libaccel/gloss_packets.h \
		$(DESTDIR)$(PREFIX)/include/gloss
	$(Q)install -m 755 $(BUILD)/$(ACCEL_SONAME) $(DESTDIR)$(LIBDIR)
	$(Q)ln -sf $(ACCEL_SONAME) $(DESTDIR)$(LIBDIR)/libaccel.so
	$(Q)install -m 644 $(BUILD)/libaccel.a $(DESTDIR)$(LIBDIR)
	$(Q)sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@LIBDIR@|$(LIBDIR)|' \
		-e 's|@VERSION@|$(ACCEL_VERSION)|' \
		-e 's|@LIBS@|$(ACCEL_LIBS)|' libaccel/libaccel.pc.in \
		>$(DESTDIR)$(LIBDIR)/pkgconfig/libaccel.pc
	$(Q)$(if $(ACCEL_SIMS),install -m 755 $(ACCEL_SIMS) $(DESTDIR)$(LIBDIR)/gloss)
# The loader finds a new library after ldconfig, which is root's to run, in the directories it knows.
	$(if $(DESTDIR),,$(Q)PATH=$$PATH:/sbin; ldconfig 2>/dev/null; \
		ldconfig -p | grep -qF '$(LIBDIR)/libaccel.so' || \
		echo 'programs do not find libaccel.so yet: run ldconfig as root, or set' \
			'LD_LIBRARY_PATH=$(LIBDIR)')
INSTALLS += install-lib
