#!/usr/bin/env bash
# Tests the AVX-512 evaluators on a processor that lacks AVX-512: boots a small Linux in the emulator bochs, and runs in
# it the programs that compare the AVX-512 evaluator with the scalar one, and its meshes with the recorded hashes.
#
#   SGM_LONG=1 [LIMIT=SECONDS] avx512_emulated.sh WORK TEST_CONFORMANCE SGM_HASHES
#
#   WORK              a folder for the kernel, which later runs use again, and for serial.txt, the guest's output
#   TEST_CONFORMANCE  path of the program test_conformance
#   SGM_HASHES        path of the program sgm_hashes
#   LIMIT             seconds of real time after which the emulator is stopped and the test fails (default: 5400)
#
# The test takes minutes and needs packages that no other test needs, so without SGM_LONG=1 it is skipped (status 77).
set -euo pipefail
(($# == 3)) || { echo "usage: avx512_emulated.sh WORK TEST_CONFORMANCE SGM_HASHES" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$1
shift
programs=("$@")
limit=${LIMIT:-5400}
kernel_package=linux-image-cloud-amd64

die() { echo "avx512_emulated: error: $1" >&2; exit 1; }
if [[ ${SGM_LONG-} != 1 ]]; then
  echo "SKIPPED: AVX-512 under emulation takes minutes: tests/run.sh --long runs it"
  exit 77
fi
for program in "${programs[@]}"; do
  [[ -x $program ]] || die "there is no program $program"
done
mkdir -p "$work"
work=$(cd "$work" && pwd)
# shellcheck source=samples/setup_debian.sh
source "$root/samples/setup_debian.sh"
sgm_setup "${SGM_EMULATION_PACKAGES[@]}"
for command in bochs-bin busybox xorriso script; do
  command -v "$command" >/dev/null || die "there is no command $command here"
done

# fetch_kernel: unpacks the kernel's package without installing it, because this machine would otherwise boot that
# kernel next time.
fetch_kernel() {
  local name folder=$work/kernel
  rm -rf "$folder"
  mkdir -p "$folder"
  name=$(apt-cache depends --important "$kernel_package" | sed -n 's/^ *Depends: \(linux-image-[0-9]\)/\1/p')
  [[ -n $name ]] || return 1
  (cd "$folder" && apt-get download -q "$name" >"$work/apt.log" 2>&1 </dev/null) || return 1
  dpkg -x "$folder"/*.deb "$folder" && mv "$folder"/boot/vmlinuz-* "$work/linux" && rm -rf "$folder"
}
if [[ ! -s $work/linux ]]; then
  fetch_kernel || die "could not unpack a kernel of $kernel_package (is the network there? run apt-get update first)"
fi

# Makes the guest's file system: the programs, the libraries that they load, the sample grammars, and a shell that
# starts them.
rm -rf "$work/guest" "$work/iso"
mkdir -p "$work"/guest/{bin,dev,lib,lib64,proc,tmp} "$work/iso"
cp "$(command -v busybox)" "$work/guest/bin/busybox"
cp -r "$root/tests/bench/grammars" "$work/guest"
for program in "${programs[@]}"; do
  cp "$program" "$work/guest/bin"
  while read -r library; do
    case $library in
      */ld-linux*) cp -L "$library" "$work/guest$library" ;;
      *) cp -L "$library" "$work/guest/lib" ;;
    esac
  done < <(ldd "$program" | grep -o '/[^ ]*')
done
# SGM_TEST_INSTRUCTION_SET makes the test fail if AVX-512 is not available, where it would otherwise be skipped. Cases
# that take too long are left out: emulation is some hundred times slower than a processor, and the cloud alone takes
# most of the time of all recorded meshes.
grep -v '^cloud' "$root/tests/determinism/golden.txt" >"$work/guest/golden.txt"
cat >"$work/guest/init" <<'END'
#!/bin/busybox sh
/bin/busybox mount -t proc none /proc
/bin/busybox mount -t devtmpfs none /dev
exec </dev/null >/dev/ttyS0 2>&1
export LD_LIBRARY_PATH=/lib SGM_TEST_INSTRUCTION_SET=avx512 SGM_TEST_ROUNDS=3 SGM_TEST_PROGRAMS=24
run() {
  echo "guest: $*"
  "$@"
  echo "guest: status $?"
}
run test_conformance --use-colour no --durations yes
run sgm_hashes /grammars /golden.txt --threads 1
echo "guest: end"
/bin/busybox poweroff -f
END
chmod +x "$work/guest/init"
(cd "$work/guest" && find . | busybox cpio -o -H newc 2>/dev/null) >"$work/iso/initrd"
cp "$work/linux" /usr/lib/ISOLINUX/isolinux.bin /usr/lib/syslinux/modules/bios/ldlinux.c32 "$work/iso"
# Without noxsaves and clearcpuid the kernel would disable AVX, because bochs reports the size of the uncompacted XSAVE
# state as that of the compacted one. The other options skip probes and loops that take long under emulation.
cat >"$work/iso/isolinux.cfg" <<'END'
default test
prompt 0
label test
  kernel /linux
  append initrd=/initrd console=ttyS0,115200 quiet noxsaves clearcpuid=xsavec mitigations=off lpj=1000000 panic=-1
END
xorriso -as mkisofs -quiet -o "$work/boot.iso" -b isolinux.bin -c boot.cat -no-emul-boot -boot-load-size 4 \
  -boot-info-table "$work/iso" >"$work/xorriso.log" 2>&1 || die "no boot image: see $work/xorriso.log"

# A high number of instructions per second makes the guest's clock advance slowly, so that few instructions are spent on
# its timer.
cat >"$work/bochsrc" <<END
display_library: term
romimage: file=/usr/share/bochs/BIOS-bochs-latest
vgaromimage: file=/usr/share/vgabios/vgabios.bin
cpu: model=corei7_skylake_x, count=1, ips=200000000, reset_on_triple_fault=0
memory: guest=512, host=512
ata0-master: type=cdrom, path="$work/boot.iso", status=inserted
boot: cdrom
com1: enabled=1, mode=file, dev="$work/serial.txt"
log: "$work/bochs.log"
panic: action=fatal
error: action=ignore
info: action=ignore
END
echo c >"$work/bochs.commands"
rm -f "$work/serial.txt" "$work/bochs.log"
started=$SECONDS
# bochs needs a terminal for its display, which `script` provides. The exit status of bochs does not tell whether the
# guest's programs passed.
TERM=vt100 timeout -k 10 "$limit" \
  script -qec "bochs-bin -q -f '$work/bochsrc' -rc '$work/bochs.commands'" /dev/null >/dev/null 2>&1 </dev/null || true

said=$(tr -d '\r' <"$work/serial.txt" 2>/dev/null) || die "the emulated machine did not start: see $work/bochs.log"
echo "$said"
elapsed="after $((SECONDS - started)) s"
# expect COUNT PATTERN WHAT: fails with the message WHAT unless COUNT lines of the guest's output match PATTERN.
expect() {
  (($(grep -cE -- "$2" <<<"$said") == $1)) ||
    die "AVX-512 is not shown to be right: $3 ($elapsed; see $work/serial.txt)"
}
expect 1 '^guest: end$' "the guest did not come to its end"
expect 0 '^SKIPPED: avx512 ' "the guest skipped avx512"
expect 1 '^comparing avx512 with scalar: ' "the guest did not compare avx512"
expect 1 '^All tests passed' "a test did not pass in the guest"
expect 1 '^[1-9][0-9]* pieces by avx512, 0 differences$' "meshes differ in the guest, or were not made by avx512"
expect ${#programs[@]} '^guest: status 0$' "a program failed in the guest"
echo "avx512_emulated: AVX-512 gives the scalar evaluator's bits, and the recorded meshes ($elapsed)"
