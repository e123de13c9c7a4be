#!/usr/bin/env bash
# Finds what pip and npm cannot bring: OpenGL, and with "test" browsers and a GPU's compiler. Installs it from Debian's
# packages where it may (root, or sudo without a password); otherwise prints the one command to run and stops.
set -euo pipefail

missing=()
has_library() { ldconfig -p 2>/dev/null | grep -q "$1" || [ -n "$(find /usr/lib /usr/local/lib -name "$1*" -print -quit 2>/dev/null)" ]; }

has_library libEGL.so.1 || missing+=(libegl1)
has_library libGL.so.1 || missing+=(libgl1)
has_library swrast_dri.so || has_library libgallium || ls /usr/share/glvnd/egl_vendor.d/*nvidia* >/dev/null 2>&1 || missing+=(libgl1-mesa-dri)
if [ "${1:-}" = test ]; then
  command -v chromium >/dev/null || command -v chromium-browser >/dev/null || missing+=(chromium)
  command -v firefox-esr >/dev/null || command -v firefox >/dev/null || missing+=(firefox-esr)
  command -v WebKitWebDriver >/dev/null || missing+=(webkit2gtk-driver)
  command -v Xvfb >/dev/null || missing+=(xvfb)
  ls /usr/share/vulkan/icd.d/radeon_icd*.json >/dev/null 2>&1 || missing+=(mesa-vulkan-drivers)
  command -v glslangValidator >/dev/null || missing+=(glslang-tools)
  command -v spirv-val >/dev/null || missing+=(spirv-tools)
fi
if ! python3 -c 'import venv, ensurepip' 2>/dev/null; then
  missing+=(python3-venv)
fi
[ ${#missing[@]} -eq 0 ] && exit 0

if ! command -v apt-get >/dev/null; then
  echo "Seafoam needs these Debian packages or their like on your system: ${missing[*]}" >&2
  exit 1
fi
# The second option leaves installed packages of the same source as they are: the OpenGL that draws stays what it was.
command="apt-get install -y --no-install-recommends -o APT::Get::Upgrade-By-Source-Package=false ${missing[*]}"
if [ "$(id -u)" -eq 0 ]; then
  as_root=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n)
else
  echo "Missing: ${missing[*]}. Run this once, then try again:" >&2
  echo "  sudo apt-get update && sudo $command" >&2
  exit 1
fi
echo "Installing Debian packages: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
# shellcheck disable=SC2086
"${as_root[@]}" $command >/dev/null
