#include "include_rules.h"

#include <algorithm>
#include <sstream>

namespace poinsot {
namespace {

std::vector<std::string> words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

bool has_word(std::string_view list, std::string_view word) {
  const std::vector<std::string> all = words(list);
  return std::find(all.begin(), all.end(), word) != all.end();
}

// Does `name` fit one of the patterns, where a '*' at the end stands for any rest?
bool fits(std::string_view patterns, std::string_view name) {
  const std::vector<std::string> all = words(patterns);
  return std::any_of(all.begin(), all.end(), [name](std::string_view pattern) {
    if (!pattern.ends_with('*')) return name == pattern;
    pattern.remove_suffix(1);
    return name.starts_with(pattern);
  });
}

std::string stem(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  return std::string(name.substr(0, name.find('.')));
}

template <class Rules, class Member>
const typename Rules::value_type* find(const Rules& rules, Member name, std::string_view key) {
  const auto found =
      std::find_if(rules.begin(), rules.end(), [&](const auto& rule) { return rule.*name == key; });
  return found == rules.end() ? nullptr : &*found;
}

// The name between the quotes or brackets of an #include line; empty if it is none.
std::string included(std::string_view line) {
  const auto skip_spaces = [&line] {
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
  };
  skip_spaces();
  if (!line.starts_with('#')) return {};
  line.remove_prefix(1);
  skip_spaces();
  if (!line.starts_with("include")) return {};
  line.remove_prefix(7);
  skip_spaces();
  if (line.empty() || (line.front() != '"' && line.front() != '<')) return {};
  const char closing = line.front() == '"' ? '"' : '>';
  return std::string(line.substr(1, line.find(closing, 1) - 1));
}

// A folder of its own, like "eigen/": of a library. sys/, linux/ and the like are the system's.
bool is_system_header(std::string_view name) {
  return name.find('/') == std::string_view::npos ||
         fits("sys/* linux/* net/* netinet/* arpa/*", name);
}

std::string check_own(const ModuleRule& rule, std::string_view name) {
  const std::string_view rest = name.substr(std::string_view("poinsot/").size());
  const std::string_view module = rest.substr(0, rest.find('/'));
  if (module != rule.module && !has_word(rule.may_include, module))
    return "must not include " + std::string(module);
  // Of the scene, the bus knows the plain structs, not the files that they are read from.
  if (has_word("protocol wire", rule.module) && fits("scene_file* scene_keys yaml_*", stem(name)))
    return "may use the plain structs of scene, not " + std::string(name);
  return {};
}

std::string check_foreign(const ModuleRule& rule, std::string_view path, std::string_view name) {
  for (const LibraryRule& library : library_rules()) {
    if (!fits(library.prefixes, name)) continue;
    if (!has_word(rule.libraries, library.library) && library.library != "eigen")
      return "must not use " + std::string(library.library);
    if (library.files.empty() || fits(library.files, stem(path))) return {};
    return std::string(library.library) + " only in: " + std::string(library.files);
  }
  if (!is_system_header(name)) return "unknown library: " + std::string(name);
  return has_word(rule.never, name) ? "must not use <" + std::string(name) + ">" : std::string();
}

}  // namespace

std::string module_of(std::string_view path) {
  if (path == "server/main.cpp") return "server_main";
  if (path == "client/main.cpp") return "client_main";
  if (path.starts_with("client/examples/")) return "examples";
  for (const std::string_view root : {"common/poinsot/", "server/poinsot/", "client/poinsot/"}) {
    if (!path.starts_with(root)) continue;
    const std::string_view rest = path.substr(root.size());
    const std::size_t slash = rest.find('/');
    return slash == std::string_view::npos ? std::string() : std::string(rest.substr(0, slash));
  }
  return {};
}

std::vector<std::string> violations(std::string_view path, std::string_view text) {
  const std::string module = module_of(path);
  const ModuleRule* const rule = find(module_rules(), &ModuleRule::module, module);
  if (rule == nullptr) return {std::string(path) + ": its module is not in the table"};
  std::vector<std::string> found;
  std::istringstream stream{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::string name = included(line);
    if (name.empty()) continue;
    const std::string what =
        name.starts_with("poinsot/") ? check_own(*rule, name) : check_foreign(*rule, path, name);
    if (!what.empty())
      found.push_back(std::string(path) + ":" + std::to_string(number) + ": " + module + " " +
                      what);
  }
  return found;
}

}  // namespace poinsot
