// Elements and looks of documents.
#include "jit/api/call.h"
#include "jit/api/handles.h"

using namespace nacre;
using namespace nacre::api;

namespace {

/// Made when it is asked for first; null where there is no memory.
template <class List>
const List* list_of(const nacre_document* document, LazyList<List> nacre_document::* list) {
  if (document == nullptr) return nullptr;
  const List* made = nullptr;
  guarded([&] {
    made = &(document->*list).get(*document->document);
    return nacre_status{NACRE_OK};
  });
  return made;
}

const ElementList* elements_of(const nacre_document* document) {
  return list_of(document, &nacre_document::elements);
}

const LookList* looks_of(const nacre_document* document) {
  return list_of(document, &nacre_document::looks);
}

}  // namespace

size_t nacre_document_element_count(const nacre_document* document) {
  const ElementList* elements = elements_of(document);
  return elements != nullptr ? elements->size() : 0;
}

nacre_status nacre_document_element(const nacre_document* document, size_t index,
                                    nacre_element* element) {
  const ElementList* elements = elements_of(document);
  if (elements == nullptr || index >= elements->size()) return NACRE_WRONG_ARGUMENTS;
  return give(element, elements->element(index));
}

size_t nacre_document_find_element(const nacre_document* document, const char* path) {
  const ElementList* elements = elements_of(document);
  return elements != nullptr ? elements->find(text_or_empty(path)) : SIZE_MAX;
}

nacre_status nacre_document_attribute(const nacre_document* document, size_t element, size_t index,
                                      const char** name, const char** value) {
  const ElementList* elements = elements_of(document);
  if (elements == nullptr || element >= elements->size()) return NACRE_WRONG_ARGUMENTS;
  const auto [found, text] = elements->attribute(element, index);
  if (found == nullptr) return NACRE_WRONG_ARGUMENTS;
  if (name != nullptr) *name = found;
  if (value != nullptr) *value = text;
  return NACRE_OK;
}

const char* nacre_document_find_attribute(const nacre_document* document, size_t element,
                                          const char* name) {
  const ElementList* elements = elements_of(document);
  if (elements == nullptr || element >= elements->size()) return nullptr;
  return elements->find_attribute(element, text_or_empty(name));
}

size_t nacre_document_look_count(const nacre_document* document) {
  const LookList* looks = looks_of(document);
  return looks != nullptr ? looks->size() : 0;
}

const char* nacre_document_look(const nacre_document* document, size_t index) {
  const LookList* looks = looks_of(document);
  return looks != nullptr && index < looks->size() ? looks->name(index) : nullptr;
}

nacre_status nacre_document_assignment(const nacre_document* document, size_t look,
                                       const char* geometry, nacre_assignment* assignment) {
  const LookList* looks = looks_of(document);
  if (looks == nullptr || look >= looks->size() || geometry == nullptr) {
    return NACRE_WRONG_ARGUMENTS;
  }
  return guarded([&] { return give(assignment, looks->assignment(look, geometry)); });
}

int nacre_document_is_visible(const nacre_document* document, size_t look, const char* geometry,
                              const char* rays, const char* viewer) {
  const LookList* looks = looks_of(document);
  if (looks == nullptr || look >= looks->size()) return 1;
  bool is_visible = true;
  guarded([&] {
    is_visible = looks->is_visible(look, text_or_empty(geometry), text_or_empty(rays),
                                   text_or_empty(viewer));
    return nacre_status{NACRE_OK};
  });
  return is_visible;
}
