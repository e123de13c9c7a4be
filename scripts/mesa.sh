#!/usr/bin/env bash
# Unpacks Mesa 25 of Debian 12's backports into a folder, beside the system's, and prints what a shell needs to render with it:
#   eval "$(scripts/mesa.sh /tmp/mesa)" && make test
set -euo pipefail

folder=${1:?"which folder?"}
mkdir -p "$folder"/{lists,packages}/partial "$folder/packages/archives/partial"
folder=$(cd "$folder" && pwd)
libraries=$folder/usr/lib/$(uname -m)-linux-gnu
if ! ls "$libraries"/libgallium-* >/dev/null 2>&1; then
  for suite in bookworm-backports bookworm; do
    echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian $suite main"
  done >"$folder/sources.list"
  own=(-o "Dir::Etc::SourceList=$folder/sources.list" -o Dir::Etc::SourceParts=/dev/null -o APT::Sandbox::User=
    -o "Dir::State::Lists=$folder/lists" -o "Dir::Cache=$folder/packages" -t bookworm-backports)
  apt-get "${own[@]}" -qq update >&2
  cd "$folder/packages"
  apt-get "${own[@]}" -qq download libegl-mesa0 libgl1-mesa-dri mesa-libgallium libgbm1 libdrm2 libdrm-amdgpu1 libdrm-intel1 \
    libpciaccess0 libllvm15 libsensors5 libelf1 libxshmfence1 libwayland-client0 libwayland-server0 libxcb-dri3-0 \
    libxcb-present0 libxcb-randr0 libxcb-sync1 libxcb-xfixes0 libglx-mesa0 >&2
  for package in ./*.deb; do dpkg -x "$package" "$folder"; done
fi
echo "export LD_LIBRARY_PATH=$libraries LIBGL_DRIVERS_PATH=$libraries/dri GBM_BACKENDS_PATH=$libraries/gbm"
echo "export __EGL_VENDOR_LIBRARY_FILENAMES=$folder/usr/share/glvnd/egl_vendor.d/50_mesa.json"
