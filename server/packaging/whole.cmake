# A package without the dashboard would be a surprise: `.ci/prepare`, or `npm run build` in web, makes it.
if(NOT EXISTS "${CPACK_TEMPORARY_DIRECTORY}/usr/share/armloom/web/index.html")
  message(FATAL_ERROR "web/dist is not there: build the dashboard first (cd web && npm ci && npm run build)")
endif()
