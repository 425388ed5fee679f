// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/digest.h"
#include "stages/pipeline_options.h"
#include "tests/fuzz/seeds.h"

namespace orbweave {

void AddTextSeeds(Seeds& seeds) {
  seeds["gnss_table"] = {
      "name,latitude,longitude,altitude,accuracy,heading,time,drive\n"
      "a.jpg,47.5,8.5,400,1.5,90,2016:11:13 11:16:31.5+02:00,one\n"
      "\"b,c.jpg\",47.6,8.6,401,,,2016-11-13T11:16:31Z,two\n",
      "SourceFile;GPSLatitude;GPSLongitude\r\nd\\a.jpg;47 deg 36' 36.70\" N;8 deg 30' 0\" E\r\n",
      "name\tx\ty\tz\na.jpg\t1\t2\t3\n",
      "#F=N X Y Z R\na.jpg 8.5 47.5 400 1 0 0 0 1 0 0 0 1\nb.jpg 8.6 47.6 401\n",
      "name,latitude,longitude\na.jpg,147.5,8.5\n"};
  seeds["cluster_table"] = {"name,cluster\na/1.jpg,north\na/2.jpg,north\nb/1.jpg,\"south, old\"\n",
                            "Cluster,Name,more\n1,1.jpg,x\n"};
  seeds["reference_poses"] = {
      "name,x,y,z,qw,qx,qy,qz\na.jpg,1,2,3,1,0,0,0\nb.jpg,1,2,3,0.6,0,0.8,0\n"};
  seeds["pipeline_options"] = {PipelineOptionsToText({}),
                               "features.max_image_width_px=4294967301\n",
                               std::string(3000, 'x') + "=1\n",
                               "# comment\nfeatures.max_image_width_px = 1024\n"};
  seeds["option_sections"] = {"align.a=1\nmerge.b=2\nfeatures.c=3\n", "sparse"};
  seeds["root_path"] = {"a/b",
                        "in",
                        "out",
                        "a/../a/b",
                        "../outside",
                        "/etc/passwd",
                        "s3://b/r/a/b.jpg",
                        "s3://b/r/../c"};
  seeds["printable_text"] = {"Straße \x1b[2J\n<b> \xe2\x80\xae\xff \xc2\x9b\xf0\x9f\x9a\x8b"};
  seeds["listen_address"] = {"127.0.0.1:7000", "unix:/run/orbweave.sock", "[::1]:0", "0.0.0.0:1"};
  seeds["http_request"] = {
      "GET /metrics HTTP/1.1\r\nHost: localhost:9464\r\nConnection: close\r\n\r\n",
      "HEAD /livez?a=b HTTP/1.0\r\nHost: [::1]\r\n\r\nGET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
      "POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n1\r\nx\r\n0\r\n\r\n",
      "GET / HTTP/1.1\r\nHost: x\r\nContent-Length: 18446744073709551615\r\nUpgrade: h2c\r\n "
      "x\r\n\r\n"};
  seeds["traceparent"] = {"00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01",
                          "cc-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-02-more"};
  seeds["collector_answer"] = {
      "{\"partialSuccess\":{\"rejectedSpans\":\"3\",\"errorMessage\":\"x\"}}",
      "{\"partialSuccess\":{\"rejectedSpans\":4}}"};
  seeds["object_page"] = {
      "<ListBucketResult><EncodingType>url</EncodingType><Contents><Key>a%2Fb</"
      "Key><LastModified>2009-10-12T17:50:30.000Z</LastModified><Size>434234</Size></"
      "Contents><IsTruncated>true</IsTruncated><NextContinuationToken>a&amp;b</"
      "NextContinuationToken></ListBucketResult>",
      "<ListBucketResult><IsTruncated>false</IsTruncated></ListBucketResult>"};
  seeds["upload_list"] = {
      "<ListMultipartUploadsResult><EncodingType>url</EncodingType><Upload><Key>a%2Fb</Key>"
      "<UploadId>u&amp;1</UploadId><Initiated>2009-10-12T17:50:30.000Z</Initiated></Upload>"
      "</ListMultipartUploadsResult>",
      "<InitiateMultipartUploadResult><UploadId>u</UploadId></InitiateMultipartUploadResult>"};
  seeds["s3_address"] = {"s3://city-blobs/orbweave/a?region=eu-central-1&style=host",
                         "s3://blobs?endpoint=http%3A//127.0.0.1:9000&plain=yes"};
  seeds["s3_keys"] = {
      "# ours\n[default]\naws_access_key_id = A\naws_secret_access_key=b\naws_session_token = "
      "c\nregion = d\n"};
  seeds["identity"] = {"orbweave://city/worker/node7"};
  seeds["revocations"] = {"name node7\nserial 0A1B\n", "token 0123456789abcdef0123456789abcdef\n"};
  seeds["digest"] = {DigestOf("blob").ToHex()};
}

}  // namespace orbweave
