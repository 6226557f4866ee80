#include "server/codec/cell_schema.h"

#include "server/codec/cell_format.h"
#include "server/codec/schema_reference.h"

namespace armloom {

const Schema& cell_schema() {
  static const Schema schema = [] {
    Schema whole{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "Armloom cell file"},
                 {"description",
                  "The robots of a cell, their arms, the scene and the settings. JSON, in which // "
                  "and /* */ comments are allowed."}};
    whole.update(cell_format().schema(Way::in));
    return whole;
  }();
  return schema;
}

std::string cell_schema_text() { return cell_schema().dump(2) + "\n"; }

std::string cell_reference_text() {
  return R"(<!-- Written by `armloom schema --markdown`: change the descriptions in server/codec/*_format.cc, not this file. -->
# The cell file

What a cell file holds: robots with their arms, the scene, and the settings. It is JSON in which `//`
and `/* */` comments are allowed. Positions are metres, angles radians, times seconds; keys carry
their unit. Paths count from the folder of the file. Unknown fields, wrong types and values out of
range are refused, all at once, each with its place (a JSON pointer) and the value found.

- `armloom import --urdf FILE --srdf FILE --out FILE` writes one from a robot's own files.
- `armloom validate --cell FILE` says what a cell holds, or everything that is wrong with it.
- Editors check and complete it with `"$schema": "cell.schema.json"`: the path to the file of that name
  here. `armloom schema` prints it, and a server has it at `/cell.schema.json`.

The smallest one:

```json
{
  "name": "cell",
  "robots": [
    {"name": "left", "urdf": "arm.urdf", "srdf": "arm.srdf", "arms": [{"name": "left", "group": "manipulator"}]}
  ]
}
```

)" + schema_reference(cell_schema());
}

}  // namespace armloom
