# Runs a command, and ends where that fails.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(result)
    message(FATAL_ERROR "${ARGV}: ${result}")
  endif()
endfunction()
