# Without dpkg-shlibdeps cpack would only warn, and make packages that depend on no library.
# cpack reads this when it begins (CPACK_PROJECT_CONFIG_FILE).
find_program(shlibdeps dpkg-shlibdeps NO_CACHE)
if(NOT shlibdeps)
  message(FATAL_ERROR "there is no dpkg-shlibdeps here to tell which libraries the packages depend on; "
                      "install the package dpkg-dev and call cpack again")
endif()
