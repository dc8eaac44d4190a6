setlocal commentstring=//\ %s comments=:///,://
setlocal shiftwidth=4 softtabstop=4 expandtab
