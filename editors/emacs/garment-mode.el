;;; garment-mode.el --- Garments written as text  -*- lexical-binding: t; -*-

;; Package-Requires: ((emacs "29.1"))

;;; Commentary:

;; A major mode for .garment files, and how eglot starts `darzi lsp' for them.

;;; Code:

(defvar garment-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?/ ". 12" table)
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?_ "w" table)
    (modify-syntax-entry ?| "." table)
    table)
  "Comments run from // to the end of the line; _ belongs to names.")

(defconst garment-mode-font-lock
  `((,(rx symbol-start
          (or "use" "let" "param" "fn" "for" "if" "then" "else" "match" "and" "or" "not" "in" "as")
          symbol-end)
     . font-lock-keyword-face)
    (,(rx symbol-start (group (+ (any alpha "_"))) (+ blank) (+ (any alnum "_"))
          (* (not (any ";{}\n"))) "{")
     (1 font-lock-keyword-face))
    (,(rx (group (any alpha "_") (* (any alnum "_"))) (* blank) ":")
     (1 font-lock-variable-name-face))
    (,(rx symbol-start (+ digit) (? "." (+ digit)) (* (any alnum "%./")))
     . font-lock-constant-face)
    (,(rx "|" (* nonl) "|") . font-lock-string-face))
  "What is coloured without the server.")

;;;###autoload
(define-derived-mode garment-mode prog-mode "Garment"
  "Major mode for garments written as text."
  (setq-local comment-start "// ")
  (setq-local comment-start-skip "//+\\s-*")
  (setq-local indent-tabs-mode nil)
  (setq-local tab-width 4)
  (setq-local font-lock-defaults '(garment-mode-font-lock)))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.garment\\'" . garment-mode))

(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs '(garment-mode . ("darzi" "lsp"))))

(provide 'garment-mode)
;;; garment-mode.el ends here
