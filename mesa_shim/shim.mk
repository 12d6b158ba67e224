# SPDX-License-Identifier: MIT
# OpenGL for programs that know nothing of Gloss: a vendor library of libglvnd, for GLX and EGL.
##@ Building

GL_PACKAGES := libglvnd gl glx egl x11 x11-xcb xcb xcb-shm
GL_FOUND := $(shell pkg-config --exists $(GL_PACKAGES) 2>/dev/null && echo yes)

FLAGS_mesa_shim := -Imesa_shim -D_GNU_SOURCE -fPIC -pthread -fvisibility=hidden \
	$(if $(GL_FOUND),$(shell pkg-config --cflags $(GL_PACKAGES)))
GL_LIBS := $(if $(GL_FOUND),$(shell pkg-config --libs x11 x11-xcb xcb xcb-shm))

SHIM_SOURCES := $(addprefix mesa_shim/api/,proc.c proc_table.c) $(sort $(wildcard mesa_shim/window/*.c))
include mesa_shim/state/state.mk mesa_shim/draw/draw.mk mesa_shim/texture/texture.mk mesa_shim/pixel/pixel.mk
SHIM_OBJECTS = $(SHIM_SOURCES:%.c=$(BUILD)/%.o)

# The library has libaccel in itself: a program that is linked with another version keeps that, and
# nobody finds the one without the other. It is loaded by either name, and then it is one library,
# so that a program with GLX and EGL has one device. It stays loaded, because threads of libaccel do.
GL_FOLDER := $(BUILD)/gl
GL_LIBRARY := $(GL_FOLDER)/libGLX_gloss.so.0
$(GL_LIBRARY): $(SHIM_OBJECTS) $(BUILD)/libaccel.a mesa_shim/shim.map
	$(call quiet,LD,$@)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -shared -Wl,-soname,$(@F) -Wl,--version-script=mesa_shim/shim.map \
		-Wl,-z,defs -Wl,-z,nodelete $(SHIM_OBJECTS) $(BUILD)/libaccel.a $(GL_LIBS) $(ACCEL_LIBS) -o $@

$(GL_FOLDER)/libEGL_gloss.so.0: $(GL_LIBRARY)
	$(Q)ln -sf $(<F) $@

$(GL_FOLDER)/90_gloss.json: mesa_shim/90_gloss.json | $(GL_LIBRARY)
	$(Q)install -m 644 $< $@

GL_FILES := $(addprefix $(GL_FOLDER)/,libGLX_gloss.so.0 libEGL_gloss.so.0 90_gloss.json)
ifneq ($(GL_FOUND),)
ALL += shim
endif

.PHONY: shim
shim: $(GL_FILES) ## build the OpenGL vendor library, build/gl

# libglvnd looks for EGL's vendors in its own folders, in the order of their names: Mesa stays the one
# that programs get without asking. One that is installed elsewhere is named in
# __EGL_VENDOR_LIBRARY_FILENAMES.
GL_DATADIR := $(if $(filter /usr /usr/local,$(PREFIX)),$(shell pkg-config --variable=datadir libglvnd \
	2>/dev/null),$(PREFIX)/share)/glvnd/egl_vendor.d

.PHONY: install-shim uninstall-shim
install-shim: shim
	$(call quiet,INSTALL,OpenGL)
	$(Q)install -d $(DESTDIR)$(LIBDIR) $(DESTDIR)$(GL_DATADIR)
	$(Q)install -m 755 $(GL_LIBRARY) $(DESTDIR)$(LIBDIR)
	$(Q)ln -sf libGLX_gloss.so.0 $(DESTDIR)$(LIBDIR)/libEGL_gloss.so.0
	$(Q)sed 's|libEGL_gloss|$(LIBDIR)/&|' mesa_shim/90_gloss.json >$(DESTDIR)$(GL_DATADIR)/90_gloss.json
	$(if $(DESTDIR),,$(Q)PATH=$$PATH:/sbin; ldconfig 2>/dev/null || true)

uninstall-shim: ## remove what install-shim put there (PREFIX, DESTDIR)
	$(Q)rm -f $(DESTDIR)$(LIBDIR)/libGLX_gloss.so.0 $(DESTDIR)$(LIBDIR)/libEGL_gloss.so.0 \
		$(DESTDIR)$(GL_DATADIR)/90_gloss.json

ifneq ($(GL_FOUND),)
INSTALLS += install-shim
endif

##@ The interface

# Khronos' description of OpenGL is Debian's package khronos-api.
GL_XML ?= /usr/share/khronos-api/gl.xml
GL_GENERATED := commands.h proc_table.c attributes.c

.PHONY: generate-shim check-generated-shim
generate: generate-shim
generate-shim:
	$(Q)mesa_shim/api/generate $(GL_XML) mesa_shim/api

check-generated: check-generated-shim
check-generated-shim:
	$(call quiet,CHECK,$(GL_XML))
	$(Q)mesa_shim/api/check $(GL_XML) $(BUILD)/generated $(GL_GENERATED)
