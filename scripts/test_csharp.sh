#!/usr/bin/env bash
# Tests the C# binding under mono: generated files, warnings, the tests with arrays alone and with spans, every C function called, the Unity component on
# stubs of UnityEngine and a real groom, the package file, the example, the code of docs/reference/csharp.md. Environment: SUPERHELIX_BUILD
# (scripts/test_library.sh).
set -euo pipefail
cd "$(dirname "$0")/.."

. scripts/test_library.sh
out=build/csharp
binding=bindings/csharp
mkdir -p "$out/files"

python3 "$binding/generate.py" --check

compiler=(mcs -unsafe -langversion:7.2 -warn:4 -warnaserror)
mapfile -d '' sources < <(find "$binding/com.superhelix.hair/Runtime" -name '*.cs' -print0 | sort -z)
# As it is outside Unity, with a comment on everything public.
"${compiler[@]}" -target:library -doc:"$out/Superhelix.xml" -out:"$out/plain.dll" "${sources[@]}"

for way in arrays spans; do
  folder=$out/$way
  defines=-define:UNITY_5_3_OR_NEWER
  [ "$way" = arrays ] || defines+=";SUPERHELIX_SPAN"
  mkdir -p "$folder"
  "${compiler[@]}" -debug -target:library "$defines" -out:"$folder/Superhelix.dll" "${sources[@]}" "$binding/tests/stubs/UnityEngine.cs"
  "${compiler[@]}" -debug "$defines" -r:"$folder/Superhelix.dll" -out:"$folder/tests.exe" "$binding"/tests/*.cs
  # mono says which native function it looks up when it is called for the first time.
  LD_LIBRARY_PATH=$library MONO_LOG_LEVEL=debug MONO_LOG_MASK=dll mono --debug "$folder/tests.exe" "$out/files" "$PWD/tests/data/grooms" >"$folder/log.txt" 2>&1 ||
    { grep -v "^Mono: " "$folder/log.txt" >&2; exit 1; }
  grep -a "tests passed" "$folder/log.txt" | sed "s/$/, with $way/"
  grep -a -o "Found as 'shx_[a-z0-9_]*" "$folder/log.txt" | sed "s/.*'//" | LC_ALL=C sort -u >"$folder/called.txt"
  nm -D --defined-only "$library/libsuperhelix.so" | awk '{ print $3 }' | LC_ALL=C sort >"$out/exported.txt"
  missed=$(LC_ALL=C comm -13 "$folder/called.txt" "$out/exported.txt")
  [ -z "$missed" ] || { echo "test_csharp.sh: the tests do not call $missed" >&2; exit 1; }
done

# The guide's code.
{
  printf 'using System;\nusing Superhelix;\ninternal static class Guide\n{\n  private static void Main()\n  {\n'
  sed -n '/^```csharp$/,/^```$/{/^```/d;p}' docs/reference/csharp.md
  printf '  }\n}\n'
} >"$out/guide.cs"
"${compiler[@]}" -r:"$out/plain.dll" -out:"$out/guide.exe" "$out/guide.cs"
LD_LIBRARY_PATH=$library mono --debug "$out/guide.exe"
"${compiler[@]}" -r:"$out/plain.dll" -out:"$out/hello.exe" "$binding/examples/Hello.cs"
prints_as_c "$out" env LD_LIBRARY_PATH="$library" mono "$out/hello.exe"

# What a user of Unity installs: a .meta file beside everything, the library where Unity finds it.
python3 "$binding/pack.py" "$out/superhelix.tgz" --linux "$library/libsuperhelix.so"
rm -rf "$out/package"
tar -C "$out" -xzf "$out/superhelix.tgz"
cmp "$out/package/Plugins/Linux/x86_64/libsuperhelix.so" "$library/libsuperhelix.so"
python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["name"] == "com.superhelix.hair"' "$out/package/package.json"
(cd "$out/package" && find . -mindepth 1 ! -name '*.meta') | while read -r item; do
  [ -f "$out/package/$item.meta" ] || { echo "test_csharp.sh: the package has no $item.meta" >&2; exit 1; }
done
doubled=$(grep -rh --include='*.meta' '^guid: ' "$out/package" | sort | uniq -d)
[ -z "$doubled" ] || { echo "test_csharp.sh: two items have $doubled" >&2; exit 1; }
