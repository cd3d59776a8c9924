#include "files/output_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "files/error.hpp"
#include "files/interrupts.hpp"

namespace app {

OutputFiles::OutputFiles(const std::vector<std::string>& inputs) {
  for (const std::string& path : inputs) {
    struct stat file;
    if (stat(path.c_str(), &file) == 0) inputs_.push_back({path, file});
  }
}

void OutputFiles::check_inputs(const OutputTarget& target, const std::string& option) const {
  for (const Input& input : inputs_)
    if (target.is(input.file))
      throw UsageError(option + ": " + target.name + " is the input " + input.path +
                       ", which would be overwritten");
}

void OutputFiles::check_others(const OutputTarget& target, const std::string& option) const {
  for (const Entry& other : entries_) {
    const OutputTarget& there = other.file->target();
    if (target.is_same(there))
      throw UsageError(other.option + " and " + option + " cannot both go to " + there.name +
                       (target.name == there.name ? "" : ", which is " + target.name + " too"));
  }
}

void OutputFiles::announce(const std::string& option, const std::string& path) {
  OutputTarget target = output_target(path);
  check_inputs(target, option);
  check_others(target, option);
  entries_.push_back({option, path, std::make_unique<Output>(std::move(target)), false});
}

Output& OutputFiles::open(const std::string& path) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.path == path; });
  if (found == entries_.end()) throw std::logic_error(path + " was not announced");
  found->is_open = true;
  return *found->file;
}

void OutputFiles::write_all() {
  for (Entry& entry : entries_)
    if (entry.is_open && entry.file->is_replaced_at_end()) entry.file->finish();
  for (Entry& entry : entries_)
    if (entry.is_open && !entry.file->is_replaced_at_end()) entry.file->flush();
}

void OutputFiles::publish() {
  write_all();
  std::vector<Output*> unpublished;
  std::vector<std::pair<std::string, std::string>> names;
  for (Entry& entry : entries_) {
    if (entry.file->unpublished().empty()) continue;
    unpublished.push_back(entry.file.get());
    names.emplace_back(entry.file->unpublished(), entry.file->target().path);
  }
  if (const std::size_t done = publish_unfinished(names); done < names.size())
    throw InputError(unpublished[done]->target().name + ": cannot be written: " + std::strerror(errno));
  for (Output* file : unpublished) file->published();
}

}  // namespace app
