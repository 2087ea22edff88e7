#!/usr/bin/env bash
# check_nginx.sh FOLDER: nginx accepts the configuration there. Ends with 77 without nginx.
set -euo pipefail
nginx=$(PATH="$PATH:/usr/sbin" command -v nginx) || { echo "needs the package nginx-light"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# In the place of Debian's nginx.conf; a port and folders that everyone may use.
sed -e "s|^proxy_cache_path [^ ]*|proxy_cache_path $folder/cache|; s|listen 80 default_server;|listen 127.0.0.1:18080;|" \
    "$1/nginx.conf" > "$folder/site.conf"
grep -q "listen 127.0.0.1:18080;" "$folder/site.conf"
grep -q "proxy_cache_path $folder/cache" "$folder/site.conf"
cat > "$folder/nginx.conf" <<END
pid $folder/pid;
error_log stderr;
events {}
http {
    access_log off;
    client_body_temp_path $folder/body;
    proxy_temp_path $folder/proxy;
    fastcgi_temp_path $folder/fastcgi;
    uwsgi_temp_path $folder/uwsgi;
    scgi_temp_path $folder/scgi;
    include $folder/site.conf;
}
END
"$nginx" -t -p "$folder" -c "$folder/nginx.conf"
