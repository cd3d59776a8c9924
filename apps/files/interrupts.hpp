// Files that are not complete yet, and are not left behind when a signal ends the program.
#pragma once

#include <sys/types.h>

#include <string>
#include <utility>
#include <vector>

namespace app {

// For main, first of all. Ctrl-C and its like remove unfinished files and then end the program as they do
// without this; what was told to ignore one still does. A file that grows beyond the limit of the process is
// an error of the write. Standard input, output and errors are open afterwards, so that no file takes their
// place.
void prepare_process();

// Makes a file of a name of its own in `folder`, with the mode that files have, and remembers it. Returns
// its descriptor, or -1 with errno set; `path` is then empty.
int create_unfinished(const std::string& folder, std::string& path);

// Removes it.
void discard_unfinished(const std::string& path);

// Renames the first of each pair to the second, whose place it takes, all of them or none; no signal comes in
// between. Returns how many there are, or, where one cannot be renamed, its index, with errno set: what stood
// at the others' places is there again.
std::size_t publish_unfinished(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace app
