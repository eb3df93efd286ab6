#include <string_view>

#include "jit/api/call.h"
#include "jit/api/handles.h"
#include "jit/api/hooks.h"
#include "jit/document/read.h"
#include "jit/graph/find.h"

using namespace nacre;
using namespace nacre::api;

namespace {

ReadOptions read_options(const nacre_read_options* given) {
  const nacre_read_options asked = options_of(given);
  ReadOptions options;
  for (const std::string& path : texts_of(asked.search_paths, asked.search_path_count)) {
    options.search_paths.emplace_back(path);
  }
  options.includes_anywhere = asked.includes_anywhere != 0;
  if (asked.max_file_bytes != 0) options.limits.file_bytes = asked.max_file_bytes;
  if (asked.max_total_bytes != 0) options.limits.total_bytes = asked.max_total_bytes;
  if (asked.max_elements != 0) options.limits.elements = asked.max_elements;
  if (asked.max_files > 0) options.limits.files = asked.max_files;
  if (asked.max_include_depth > 0) options.limits.include_depth = asked.max_include_depth;
  if (asked.max_xml_depth > 0) options.limits.xml_depth = asked.max_xml_depth;
  if (asked.max_inheritance > 0) {
    options.limits.inheritance = static_cast<std::size_t>(asked.max_inheritance);
  }
  options.stop = stop_of(asked.stop);
  if (asked.resolver != nullptr) {
    nacre_file_resolver resolver = options_of(asked.resolver);
    resolver.destroy = nullptr;
    options.resolver = host_resolver(resolver);
  }
  return options;
}

bool is_meant(const nacre_read_options* given) {
  return has_size(given) && has_size(options_of(given).resolver);
}

nacre_status hand_out(std::unique_ptr<Document> read, nacre_document** document) {
  if (read == nullptr) return NACRE_FAILED;
  auto made = std::make_unique<nacre_document>();
  for (const FoundMaterial& material : find_materials(*read)) {
    made->materials.push_back(material.name);
  }
  for (const FoundOutput& output : find_outputs(*read)) {
    if (has_kernel(output.type)) made->outputs.push_back(output.name);
  }
  made->document = std::move(read);
  *document = made.release();
  return NACRE_OK;
}

const char* name_at(const std::vector<std::string>& names, std::size_t index) {
  return index < names.size() ? names[index].c_str() : nullptr;
}

}  // namespace

nacre_status nacre_document_read(const char* file, const nacre_read_options* options,
                                 nacre_report* report, nacre_document** document) {
  if (file == nullptr || document == nullptr || !is_meant(options)) return NACRE_WRONG_ARGUMENTS;
  *document = nullptr;
  return guarded(report, [&] {
    Said said(report);
    return hand_out(read_document(file, read_options(options), said.diagnostics()), document);
  });
}

nacre_status nacre_document_parse(const char* text, size_t length, const char* name,
                                  const nacre_read_options* options, nacre_report* report,
                                  nacre_document** document) {
  if (text == nullptr || document == nullptr || !is_meant(options)) return NACRE_WRONG_ARGUMENTS;
  *document = nullptr;
  return guarded(report, [&] {
    Said said(report);
    return hand_out(read_document_text({text, length}, text_or_empty(name), read_options(options),
                                       said.diagnostics()),
                    document);
  });
}

void nacre_document_destroy(nacre_document* document) { delete document; }

size_t nacre_document_material_count(const nacre_document* document) {
  return document != nullptr ? document->materials.size() : 0;
}

const char* nacre_document_material(const nacre_document* document, size_t index) {
  return document != nullptr ? name_at(document->materials, index) : nullptr;
}

size_t nacre_document_output_count(const nacre_document* document) {
  return document != nullptr ? document->outputs.size() : 0;
}

const char* nacre_document_output(const nacre_document* document, size_t index) {
  return document != nullptr ? name_at(document->outputs, index) : nullptr;
}
