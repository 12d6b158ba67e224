# SPDX-License-Identifier: MIT
"""The processes of the virtual machine: QEMU, and the boards that it talks to."""

import os
import re
import selectors
import socket
import subprocess
import time

from vm_plan import fail

# The engine of each board, and its slot of QEMU's bus pcie.0: in the order of the slots, since
# they are numbered in the guest in that order.
BOARDS = (("rtl", 8), ("model", 9))
# The engine, speed and serial number of each board on USB.
USB_BOARDS = (("rtl", "high", "RTL0"), ("model", "super", "MODEL0"))
PASSED, FAILED = 0, 1


class Machine:
    """The processes of a virtual machine. None of them outlives this one, however it ends."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = folder
        self.children = []

    def start(self, argv, **more):
        child = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *argv], **more)
        self.children.append(child)
        return child

    def stop(self):
        for child in self.children:
            if child.poll() is None:
                child.kill()
        for child in self.children:
            child.wait()

    def start_boards(self):
        """Starts vboard-pci; returns for each board the socket that QEMU gets."""
        pairs = [socket.socketpair() for _ in BOARDS]
        argv = [f"{self.options.build}/vboard-pci", "--qtest", f"{self.folder}/qtest"]
        for (engine, slot), (ours, _) in zip(BOARDS, pairs):
            argv += ["--board", f"{engine},fd={ours.fileno()},slot={slot}"]
        with open(f"{self.options.results}/vboard.log", "wb") as log:
            self.boards = self.start(
                argv,
                pass_fds=[ours.fileno() for ours, _ in pairs],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
            )
        for ours, _ in pairs:
            ours.close()
        return [theirs for _, theirs in pairs]

    def usb_socket(self, serial):
        return f"{self.folder}/usb-{serial}"

    def start_usb(self):
        """Starts vboard-usb, when QEMU is there or once more if it has ended."""
        ends = [self.connect(self.usb_socket(serial)) for _, _, serial in USB_BOARDS]
        argv = [f"{self.options.build}/vboard-usb"]
        for (engine, speed, serial), end in zip(USB_BOARDS, ends):
            argv += ["--board", f"{engine},fd={end.fileno()},speed={speed},serial={serial}"]
        with open(f"{self.options.results}/vboard-usb.log", "ab") as log:
            self.usb = self.start(
                argv,
                pass_fds=[end.fileno() for end in ends],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
            )
        for end in ends:
            end.close()

    def connect(self, path):
        end = socket.socket(socket.AF_UNIX)
        while self.qemu.poll() is None:
            try:
                end.connect(path)
                break
            except OSError:
                time.sleep(0.01)
        return end

    def start_qemu(self, kernel, sockets):
        results = self.options.results
        memory = "1G" if self.options.debug else "512M"
        # The interactive terminal's keys, Ctrl-C too, are the guest's.
        console = "stdio,id=console" + (",signal=off" if self.options.interactive else "")
        argv = [
            *"qemu-system-x86_64 -nodefaults -no-user-config -display none -no-reboot".split(),
            *"-machine q35,memory-backend=ram -accel tcg -cpu max -smp 1".split(),
            *f"-m {memory} -object memory-backend-memfd,id=ram,size={memory},share=on".split(),
            *["-kernel", kernel, "-initrd", f"{self.folder}/initramfs"],
            *["-append", self.command_line()],
            *["-chardev", console, "-serial", "chardev:console"],
            *["-chardev", f"file,id=log,path={quoted(results)}/kernel.log"],
            *["-serial", "chardev:log"],
            *share("host", "/", "readonly=on,multidevs=remap"),
            *share("out", results, "multidevs=remap"),
            *"-device isa-debug-exit,iobase=0xf4,iosize=4".split(),
            *["-qtest", f"unix:{quoted(self.folder)}/qtest,server=on,wait=off"],
            *["-qtest-log", "none"],
        ]
        for (_, slot), end in zip(BOARDS, sockets):
            argv += ["-device", f"x-pci-proxy-dev,fd={end.fileno()},addr={slot}"]
        argv += ["-device", "qemu-xhci,id=xhci"]
        for _, _, serial in USB_BOARDS:
            path = quoted(self.usb_socket(serial))
            argv += ["-chardev", f"socket,id={serial},path={path},server=on,wait=off"]
            argv += ["-device", f"usb-redir,bus=xhci.0,chardev={serial}"]
        plain = {} if self.options.interactive else {"stdin": subprocess.DEVNULL}
        with open(f"{results}/qemu.log", "wb") as log:
            self.qemu = self.start(
                argv,
                env=dict(os.environ, LD_PRELOAD=f"{self.options.build}/tests/vm/no_kvm.so"),
                pass_fds=[end.fileno() for end in sockets],
                stdout=None if self.options.interactive else subprocess.PIPE,
                stderr=log,
                **plain,
            )
        for end in sockets:
            end.close()

    def command_line(self):
        # On a busy host the clocks seem not to agree.
        words = "console=ttyS1 loglevel=7 panic=-1 printk.devkmsg=on log_buf_len=4M tsc=reliable"
        if self.options.debug:
            # Of the DMA of our driver: two small transfers of the kernel's own USB code may lie in
            # one line of the cache, which is an error on machines that are not x86.
            words += " kasan_multi_shot dma_debug_driver=gloss"
        return " ".join([words, *self.options.append])

    def watch(self):
        """Shows the guest's console until it ends; returns whether it said that all went well."""
        seconds = self.options.timeout * self.options.slow
        until = time.monotonic() + seconds
        shown = Console()
        with selectors.DefaultSelector() as selector:
            selector.register(self.qemu.stdout, selectors.EVENT_READ)
            while True:
                if selector.select(0.5):
                    data = os.read(self.qemu.stdout.fileno(), 65536)
                    if not data:
                        break
                    shown.add(data)
                self.watch_boards()
                if time.monotonic() > until:
                    self.explain(f"not done after {seconds} s", "kernel.log")
        return self.verdict(self.qemu.wait(), shown.summary)

    def watch_boards(self):
        if self.boards.poll() not in (None, 0):
            self.explain("vboard-pci ended early", "vboard.log")
        if self.usb.poll() not in (None, 0):
            self.explain("vboard-usb ended early", "vboard-usb.log")
        # A test had it end.
        if self.usb.poll() == 0 and self.qemu.poll() is None:
            self.start_usb()

    def wait(self):
        """Until the guest ends, while it has a shell."""
        while True:
            try:
                self.qemu.wait(0.5)
                return PASSED
            except subprocess.TimeoutExpired:
                self.watch_boards()

    def verdict(self, status, summary):
        # isa-debug-exit makes 1 of the runner's 0, and 3 of its 1.
        if status == 1 and summary:
            return PASSED
        if status == 3:
            return FAILED
        if status not in (0, 1):
            self.explain(f"QEMU ended with {status}", "qemu.log")
        return self.explain("the guest ended before the tests did", "kernel.log")

    def explain(self, what, log):
        """Fails, with the last lines of a log."""
        with open(f"{self.options.results}/{log}", errors="replace", encoding="utf-8") as file:
            lines = file.read().splitlines()[-40:]
        fail("\n".join([what + f"; the last of {self.options.results}/{log}:", *lines]))


class Console:
    """Lines that the guest prints."""

    def __init__(self):
        self.rest = b""
        self.summary = False

    def add(self, data):
        *lines, self.rest = (self.rest + data).split(b"\n")
        for line in lines:
            text = line.decode(errors="replace").rstrip("\r")
            self.summary |= bool(re.fullmatch(r"vm: \d+ passed, \d+ failed, \d+ skipped", text))
            print(text, flush=True)


def quoted(path):
    """A path inside one of QEMU's option lists."""
    return path.replace(",", ",,")


def share(tag, path, more):
    return ["-virtfs", f"local,path={quoted(path)},mount_tag={tag},security_model=none,{more}"]
