#!/bin/bash
# install_packages.sh ROLE...: installs the packages of packages.txt that have one of the roles and
# are missing. When none is missing it neither calls apt nor needs to be root.
set -euo pipefail

list=$(dirname "$(realpath "$0")")/packages.txt
wanted=$(awk -v roles=" $* " '
  { sub(/#.*/, "") }
  { for (i = 2; i <= NF; ++i) if (index(roles, " " $i " ")) { print $1; break } }' "$list")

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "Not a Debian system: packages are not installed; needed are:" $wanted >&2
  exit 0
fi

installed=" $(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null |
  awk '$1 == "installed" { printf "%s ", $2 }' || true)"
missing=()
for package in $wanted; do
  [[ $installed == *" $package "* ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
if [[ $(id -u) != 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "Missing packages and neither root nor sudo to install them. As root, type:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT

# Runs apt-get; on a terminal one line shows how far it is, the rest goes to the log.
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -q -o DPkg::Lock::Timeout=300 \
    -o APT::Status-Fd=1 "$@" </dev/null 2>&1 |
    awk -v log_file="$log" -v terminal="$([[ -t 2 ]] && echo 1 || echo 0)" -F: '
      /^(dl|pm)status:/ {
        if (terminal) printf "\r\033[K  %s %3d %%", $1 == "dlstatus" ? "fetch  " : "install",
                             $3 > "/dev/stderr"
        next
      }
      { print > log_file }
      END { if (terminal) printf "\r\033[K" > "/dev/stderr" }'
}

echo "Installing ${#missing[@]} packages: ${missing[*]}" >&2
# A machine whose package lists are fresh enough may do without the update.
apt update || echo "apt-get update failed; trying with the lists there are" >&2
if ! apt install --no-install-recommends "${missing[@]}"; then
  cat "$log" >&2
  echo "Installing packages failed; see above." >&2
  exit 1
fi
