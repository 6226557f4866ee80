#include "server/codec/cell_schema.h"

#include "server/codec/cell_format.h"
#include "server/codec/schema_reference.h"

namespace armloom {

const Schema& cell_schema() {
  static const Schema schema = [] {
    Schema whole{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "Armloom cell file"},
                 {"description",
                  "The robots of a cell, their arms, the scene and the settings. JSON with // and "
                  "/* */ comments."}};
    whole.update(cell_format().schema(Way::in));
    return whole;
  }();
  return schema;
}

std::string cell_schema_text() { return cell_schema().dump(2) + "\n"; }

std::string cell_reference_text() {
  return R"(<!-- Written by `armloom schema --markdown`: change the descriptions in server/codec/*_format.cc, not this file. -->
# The cell file

A cell file describes the robots with their arms, the scene, and the settings. It is JSON with `//`
and `/* */` comments. Positions are in meters, angles in radians, times in seconds; keys carry their
unit. Relative paths start at the folder of the file. Unknown fields, wrong types and values out of
range are reported all at once, each with its place (a JSON pointer) and the value found.

- `armloom import --urdf FILE --srdf FILE --out FILE` writes a cell file from a robot's own files.
- `armloom validate --cell FILE` prints what a cell contains, or all of its faults.
- Editors check and complete a file with `"$schema": "cell.schema.json"`, the path of that file in
  this folder. `armloom schema` prints the schema, and a server serves it at `/cell.schema.json`.

The smallest cell file:

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
