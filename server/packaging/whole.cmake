# Refuses a package without the dashboard, which `.ci/prepare` or `npm run build` in web makes.
if(NOT EXISTS "${CPACK_TEMPORARY_DIRECTORY}/usr/share/armloom/web/index.html")
  message(FATAL_ERROR "web/dist is missing: build the dashboard first (cd web && npm ci && npm run build)")
endif()
