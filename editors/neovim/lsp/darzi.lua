-- Neovim 0.11 reads this for `vim.lsp.enable("darzi")`.
return {
  cmd = { "darzi", "lsp" },
  filetypes = { "garment" },
  root_markers = { ".git" },
}
