# SPDX-License-Identifier: MIT
"""What is run in the virtual machine: the kernel, the tests, and what the guest gets."""

import os
import re
import shutil
import struct
import subprocess

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE = os.path.dirname(os.path.dirname(HERE))
MODPROBE = ("drm", "drm_shmem_helper", "gpu-sched", "xhci_pci")


class NotRun(Exception):
    """Why the tests could not be run."""


def fail(message):
    raise NotRun(message)


# ---- the kernel and the tests ----


def read_release(image):
    """The version of a bzImage: Documentation/x86/boot.rst, kernel_version."""
    try:
        with open(image, "rb") as file:
            head = file.read(64 * 1024)
    except OSError as error:
        fail(f"{image}: {error.strerror}")
    if head[0x202:0x206] != b"HdrS":
        fail(f"{image} is not a bzImage")
    offset = struct.unpack_from("<H", head, 0x20E)[0] + 0x200
    return head[offset : head.index(0, offset)].decode().split()[0]


def module_release(driver):
    module = f"{driver}/gloss.ko"
    if not os.path.exists(module):
        fail(f"no {module}; run 'make vm-modules'")
    path = os.environ.get("PATH", "") + ":/sbin:/usr/sbin"
    modinfo = shutil.which("modinfo", path=path) or fail("no modinfo; install kmod (make deps)")
    text = subprocess.run(
        [modinfo, "-F", "vermagic", module], check=True, capture_output=True, text=True
    )
    return text.stdout.split()[0]


def debian_kernel(name, *show):
    """The first line of tests/vm/kernels: of a series or a release, or of the newest if ""."""
    found = subprocess.run(
        [f"{HERE}/kernels", *show, *name.split()], capture_output=True, text=True
    )
    if found.returncode:
        fail(found.stderr.strip())
    return found.stdout.split()[0]


def choose_kernel(options):
    """Fills in the image, and what is named after the kernel's series, as tests/vm/vm.mk does."""
    if "/" in options.kernel:
        options.image, name = options.kernel, ""
    elif options.driver and not options.kernel:
        options.image, name = f"/boot/vmlinuz-{module_release(options.driver)}", ""
    else:
        options.image = f"/boot/vmlinuz-{debian_kernel(options.kernel, '--release')}"
        name = "-" + debian_kernel(options.kernel)
    options.driver = os.path.realpath(options.driver or f"{options.build}/driver{name}")
    options.results = os.path.realpath(options.results or f"{options.build}/vm{name}")


def check_kernel(options):
    """The release of the image, which has to be the one that the module is for."""
    wanted = module_release(options.driver)
    if not os.path.exists(options.image):
        fail(
            f"no {options.image}, though gloss.ko is for {wanted}; install linux-image-{wanted}, "
            "or build the module for a kernel that is installed: make vm-modules"
        )
    release = read_release(options.image)
    if release != wanted:
        fail(f"{options.image} is {release}, but gloss.ko is for {wanted}; run 'make vm-modules'")
    return release


def read_list(path):
    """The tests of a list: a line has WHO:NAME[:SECONDS]."""
    tests = {}
    try:
        with open(path, encoding="utf-8") as file:
            lines = file.read().split()
    except OSError as error:
        fail(f"{path}: {error.strerror}; run 'make vm-programs'")
    for line in lines:
        match = re.fullmatch(r"(root|user):([A-Za-z0-9_-]+)(?::([0-9]+))?", line)
        if not match:
            fail(f"{path}: not WHO:NAME[:SECONDS]: {line}")
        tests[match[2]] = (match[1], int(match[3] or 300))
    return tests


def choose_tests(options):
    tests = read_list(f"{options.build}/tests/vm/list")
    for name in options.tests + options.without:
        if name not in tests:
            fail(f"no test {name}; --list lists all")
    names = options.tests or [name for name in tests if name not in options.without]
    chosen = {name: tests[name] for name in names}
    for name in chosen:
        if not os.access(f"{options.build}/tests/vm/{name}", os.X_OK):
            fail(f"no program {options.build}/tests/vm/{name}; run 'make vm-programs'")
    return chosen


# ---- what the guest gets ----


def guest_user():
    """Who the ordinary user of the guest is: one who may read what is tested."""
    return os.getuid() or os.stat(SOURCE).st_uid or 1000


def check_readable(path, user):
    """The guest checks the rights of a file by its owner and mode, as the host does."""
    stat = os.stat(path)
    if stat.st_uid != user and stat.st_mode & 0o005 != 0o005:
        fail(f"{path} can not be read by others, such as the guest's user {user}; chmod o+rx it")


def bound_folders(options):
    """What the guest has to see of the host besides its system, without what is inside others."""
    wanted = [SOURCE, options.build, options.driver]
    if options.modules not in ("/", "none"):
        wanted.append(options.modules)
    return [
        path
        for path in sorted(set(wanted))
        if not any(path.startswith(other + "/") for other in wanted)
    ]


def write_plan(options, tests):
    user = guest_user()
    lines = [f"out {options.results}", f"runner {options.build}/tests/vm/runner"]
    for folder in bound_folders(options):
        check_readable(folder, user)
        lines.append(f"bind {folder}")
    lines += [
        f"source {SOURCE}",
        f"build {options.build}",
        f"driver {options.driver}",
        f"user {user}",
        f"slow {options.slow}",
    ]
    if options.modules != "none":
        lines.append(f"modules {options.modules}")
        lines += [f"modprobe {name}" for name in MODPROBE]
    for key, name in (("seed", "GLOSS_SEED"), ("points", "GLOSS_POINTS")):
        if name in os.environ:
            lines.append(f"{key} {os.environ[name]}")
    if options.debug:
        lines.append("debug")
    if options.interactive:
        size = shutil.get_terminal_size()
        lines += ["interactive", f"rows {size.lines}", f"columns {size.columns}"]
        lines.append(f"term {os.environ.get('TERM', 'linux')}")
    lines += [f"test {who} {seconds} {name}" for name, (who, seconds) in tests.items()]
    with open(f"{options.results}/plan", "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    if os.getuid() == 0:
        os.chown(options.results, user, -1)


def empty_results(folder):
    """Makes the folder, or empties it if it is one of ours."""
    if os.path.exists(folder) and os.listdir(folder):
        if not os.path.exists(f"{folder}/plan"):
            fail(f"{folder} is not empty, and not of a former run")
        shutil.rmtree(folder)
    os.makedirs(folder, exist_ok=True)


def make_initramfs(options, release, out):
    known = "none" if options.modules == "none" else release
    made = subprocess.run(
        [f"{HERE}/initramfs", out, known, options.modules], capture_output=True, text=True
    )
    if made.returncode:
        fail(made.stderr.strip())


def make_kernel(image, out):
    """The image, or what is in it where that can be booted."""
    made = subprocess.run([f"{HERE}/unpack", image, out])
    return out if made.returncode == 0 else image
