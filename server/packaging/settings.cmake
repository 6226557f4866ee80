# Runs on installation: writes the systemd unit and the settings with the folders of the prefix. For
# /usr these are in /etc and /var (Filesystem Hierarchy Standard), otherwise below the prefix.
get_filename_component(PREFIX "${CMAKE_INSTALL_PREFIX}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
if(PREFIX STREQUAL "/usr")
  set(root "")
else()
  set(root ${PREFIX})
endif()
set(ETC ${root}/etc/armloom)
set(DATA ${root}/var/lib/armloom)

configure_file(${from}/armloom.service.in ${made}/armloom.service @ONLY)
configure_file(${from}/server.conf.in ${made}/server.conf @ONLY)
file(READ ${cell} text)
string(REPLACE "\"../models/" "\"${PREFIX}/share/armloom/models/" text "${text}")
string(REPLACE "\"cell.schema.json\"" "\"${PREFIX}/share/armloom/config/cell.schema.json\"" text "${text}")
file(WRITE ${made}/cell.json "${text}")

file(INSTALL DESTINATION ${PREFIX}/lib/systemd/system FILES ${made}/armloom.service)
file(INSTALL DESTINATION ${ETC} FILES ${made}/server.conf ${made}/cell.json)
