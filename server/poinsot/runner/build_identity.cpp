#include "poinsot/runner/build_identity.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <elf.h>
#include <link.h>
#include <string_view>

#include "poinsot/base/check.h"

namespace poinsot {
namespace {

#ifdef __clang__
constexpr std::string_view kCompiler = __VERSION__;
#else
constexpr std::string_view kCompiler = "GCC " __VERSION__;
#endif

constexpr char kOwner[] = "GNU";  // of the note, with its zero

struct Search {
  std::uintptr_t inside;  // an address of the object that is looked for
  std::string id;
};

std::size_t rounded_up(std::size_t size) {
  return (size + 3) & ~std::size_t{3};
}

// The linker's hash as hexadecimal digits, if one of the notes is that.
std::string build_id(const char* notes, std::size_t size) {
  ElfW(Nhdr) note;
  while (size >= sizeof note) {
    std::memcpy(&note, notes, sizeof note);
    const char* const name = notes + sizeof note;
    const char* const value = name + rounded_up(note.n_namesz);
    const std::size_t length = sizeof note + rounded_up(note.n_namesz) + rounded_up(note.n_descsz);
    if (length > size) break;
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == sizeof kOwner &&
        std::memcmp(name, kOwner, sizeof kOwner) == 0) {
      std::string id;
      for (std::size_t k = 0; k < note.n_descsz; ++k) {
        const auto byte = static_cast<unsigned char>(value[k]);
        id += "0123456789abcdef"[byte >> 4];
        id += "0123456789abcdef"[byte & 15];
      }
      return id;
    }
    notes += length;
    size -= length;
  }
  return {};
}

// Called for the program and each shared library; another value than 0 ends the search.
int look_at(dl_phdr_info* object, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  bool is_ours = false;
  std::string id;
  for (std::size_t k = 0; k < object->dlpi_phnum; ++k) {
    const ElfW(Phdr)& header = object->dlpi_phdr[k];
    const std::uintptr_t first = object->dlpi_addr + header.p_vaddr;
    if (header.p_type == PT_LOAD)
      is_ours = is_ours || (search.inside >= first && search.inside < first + header.p_memsz);
    if (header.p_type == PT_NOTE && id.empty())
      id = build_id(reinterpret_cast<const char*>(first), header.p_memsz);
  }
  if (is_ours) search.id = id;
  return is_ours ? 1 : 0;
}

std::string make_identity() {
  // The linker was told to write one, see server/CMakeLists.txt.
  Search search{reinterpret_cast<std::uintptr_t>(kCompiler.data()), {}};
  dl_iterate_phdr(look_at, &search);
  POINSOT_CHECK(!search.id.empty());
  return std::string(POINSOT_VERSION ", ").append(kCompiler).append(", ") + search.id;
}

}  // namespace

const std::string& build_identity() {
  static const std::string identity = make_identity();
  return identity;
}

}  // namespace poinsot
