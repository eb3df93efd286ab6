// Uses the installed library for what a host does first, and fails if it does not answer.
#include <iostream>
#include <nacre/nacre.hpp>

int main() {
  const nacre::Document document = nacre::Document::parse(
      R"(<materialx version="1.39"><constant name="c" type="color3">
           <input name="value" type="color3" value="0.25, 0.5, 1"/></constant>
         <output name="out" type="color3" nodename="c"/></materialx>)");
  if (document.outputs() != std::vector<std::string>{"out"}) return 1;
  nacre::System system;
  if (system.nodedefs().size() < 600) return 2;
  const nacre::Shader shader = system.compile_outputs(document, {"out"});
  nacre::Binder binder;
  binder.array("out", {0, 0, 3 * sizeof(float)});
  const nacre::Binding binding(binder, shader);
  float color[3] = {};
  nacre::Batch batch;
  batch.count = 1;
  binding.run(NACRE_OUTPUTS, std::vector<void*>{color}, batch);
  std::cout << color[0] << ' ' << color[1] << ' ' << color[2] << '\n';
  return color[0] == 0.25f && color[1] == 0.5f && color[2] == 1 ? 0 : 3;
}
