#!/usr/bin/env bash
# Checks the format of C++ (clang-format) and of TypeScript and JavaScript (prettier);
# `npm run format` applies it.
set -uo pipefail
cd "$(dirname "$0")/.."

kClangFormat=14 # other versions format some lines differently
failed=0

if clang-format --version 2>/dev/null | grep -q "version $kClangFormat\."; then
  git ls-files -z '*.h' '*.cpp' | xargs -0 clang-format --dry-run -Werror || failed=1
else
  echo "check-format: clang-format $kClangFormat is not installed; C++ is not checked" >&2
fi
npx prettier --check --log-level warn . || failed=1

[ $failed = 0 ] || echo 'check-format: run npm run format' >&2
exit $failed
