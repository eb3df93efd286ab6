#pragma once

#include <map>
#include <string>

namespace graph_image {

/// What an image is asked for by: a document and what is wanted of it.
struct ImageName {
  std::string file;                           ///< Before the "?".
  std::map<std::string, std::string> values;  ///< "size=512&frame=3" behind it, by key.
};

/// "marble.mtlx?output=NG_marble/base_color&size=4096". Throws Wrong where a part behind the "?"
/// is no "key=value" or a key is there twice.
ImageName split_name(const std::string& name);

/// A name that is a text file, `wood.mtlxtex`, as what it stands for: its one line, the name of a
/// document beside it with what is wanted, for programs that take existing files only. Lines that
/// are empty or begin with # do not count; what `name` itself asks for counts before what the line
/// does. Any other name is given back. Throws Wrong.
ImageName follow(const ImageName& name);

/// Whether the file of a name could be one of ours, by its extension, whatever its case; that is
/// asked of every file that no other reader knows, so nothing is opened.
bool is_graph_image(const std::string& file);

}  // namespace graph_image
